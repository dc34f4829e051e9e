"use strict";
// The page of a comparison: layers on and off, and from a row of the table to its place in the picture.

{
  const paper = hlr.part("paper");
  const svg = paper.querySelector("svg");
  const table = hlr.part("differences");
  const target = hlr.part("target");

  // A line is seen where no layer that it is in is switched off, and so is a row.
  const layers = [...document.querySelectorAll("[data-layer]")];
  const rows = table ? [...table.querySelectorAll("tr[data-x]")] : [];
  const sift = () => {
    const off = layers.filter((input) => !input.checked).flatMap((input) => input.dataset.layer.split(" "));
    const isOff = (element) => off.some((name) => element.classList.contains(name));
    for (const path of svg.querySelectorAll("path[class]")) path.classList.toggle("off", isOff(path));
    for (const row of rows) row.hidden = isOff(row);
  };
  for (const input of layers) input.addEventListener("change", sift);

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
