"use strict";
// The page of a comparison: layers on and off, and from a row of the table to its place in the picture.

{
  const paper = hlr.part("paper");
  const svg = paper.querySelector("svg");
  const table = hlr.part("differences");
  const target = hlr.part("target");

  for (const input of document.querySelectorAll("[data-layer]")) {
    input.addEventListener("change", () => {
      for (const name of input.dataset.layer.split(" ")) {
        for (const path of svg.querySelectorAll(`path.${CSS.escape(name)}`)) path.classList.toggle("off", !input.checked);
      }
      const kind = input.dataset.kind;
      if (kind && table) for (const row of table.querySelectorAll(`tr.${CSS.escape(kind)}`)) row.hidden = !input.checked;
    });
  }

  const show = (row) => {
    const perMillimetre = svg.clientWidth / svg.viewBox.baseVal.width;
    const [x, y, around] = ["x", "y", "around"].map((name) => Number(row.dataset[name]) * perMillimetre);
    hlr.zoom.look(x, y, around);
    target.hidden = true; // and seen again, so that it flashes anew
    target.style.left = `${x}px`;
    target.style.top = `${y}px`;
    requestAnimationFrame(() => (target.hidden = false));
    table.querySelector("[aria-current]")?.removeAttribute("aria-current");
    row.setAttribute("aria-current", "true");
  };

  table?.addEventListener("click", (event) => {
    const row = event.target.closest("tr[data-x]");
    if (row) show(row);
  });
  table?.addEventListener("keydown", (event) => {
    const row = event.target.closest("tr[data-x]");
    if (!row) return;
    const next = { ArrowDown: row.nextElementSibling, ArrowUp: row.previousElementSibling }[event.key];
    if (event.key === "Enter") show(row);
    else if (next) next.focus();
    else return;
    event.preventDefault();
  });

  window.addEventListener("resize", hlr.zoom.fit);
  hlr.zoom.fit();
}
