"use strict";
// The keyboard. Escape closes the viewer by itself, as it is a dialog.

{
  const inViewer = {
    ArrowLeft: () => hlr.step(-1),
    ArrowRight: () => hlr.step(1),
    "+": () => hlr.zoom.in(),
    "=": () => hlr.zoom.in(),
    "-": () => hlr.zoom.out(),
    0: () => hlr.zoom.fit(),
  };

  const onSheet = { "/": () => hlr.part("search").focus() };
  for (const arrow of ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"]) onSheet[arrow] = () => hlr.moveAmongCards(arrow);

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("input, select")) {
      if (event.key === "Escape" && event.target.matches("[data-search]")) event.target.blur();
      return;
    }
    const action = (hlr.viewing() ? inViewer : onSheet)[event.key];
    if (action) {
      event.preventDefault();
      action();
    }
  });
}
