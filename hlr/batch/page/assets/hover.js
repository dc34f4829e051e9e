"use strict";
// The line under the pointer, or near it: its part, class and edge are named, and all of that edge is marked.

{
  const stage = hlr.part("stage");
  const hint = hlr.part("hint");
  const reach = [0, 2, 4, 7]; // pixels: lines are thin
  let [svg, parts, marked, asked] = [null, new Map(), [], null];

  const classes = "g.visible > g, g.hidden > g"; // groups of lines of one class

  const lineAt = (x, y) => {
    for (const radius of reach) {
      for (let turn = 0; turn < (radius ? 8 : 1); turn += 1) {
        const angle = (turn * Math.PI) / 4;
        const found = document.elementFromPoint(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
        if (found?.closest(classes) && svg?.contains(found)) return found;
      }
    }
    return null;
  };

  const partOf = (line) => line.closest("[data-part]")?.dataset.part ?? "";

  // "bolt · sharp edge 12 · hidden". An intersection belongs to two parts, and to no edge.
  const nameOf = (line) => {
    const { edge, other } = line.dataset;
    const kind = line.closest(classes).getAttribute("class");
    return [
      parts.get(partOf(line)),
      edge === undefined ? kind : `${kind} edge ${edge}`,
      other === undefined ? "" : `with ${parts.get(other) ?? `part ${other}`}`,
      line.closest("g.hidden") ? "hidden" : "visible",
    ]
      .filter(Boolean)
      .join(" · ");
  };

  const mark = (line) => {
    for (const each of marked) each.classList.remove("marked");
    const edge = line?.dataset.edge;
    if (edge === undefined) marked = line ? [line] : [];
    else marked = [...svg.querySelectorAll(`[data-part="${CSS.escape(partOf(line))}"] [data-edge="${CSS.escape(edge)}"]`)];
    for (const each of marked) each.classList.add("marked");
  };

  const show = (x, y) => {
    const line = hlr.zoom.held() ? null : lineAt(x, y);
    mark(line);
    hint.hidden = !line;
    if (!line) return;
    hint.textContent = nameOf(line);
    const { left, top, width, height } = stage.getBoundingClientRect();
    hint.style.left = `${Math.max(0, Math.min(x - left + 14, width - hint.offsetWidth - 8))}px`;
    hint.style.top = `${Math.max(0, Math.min(y - top + 18, height - hint.offsetHeight - 8))}px`;
  };

  // Once a frame at most: large drawings take their time.
  stage.addEventListener("pointermove", (event) => {
    if (asked === null) {
      requestAnimationFrame(() => {
        const [x, y] = asked;
        asked = null;
        show(x, y);
      });
    }
    asked = [event.clientX, event.clientY];
  });
  stage.addEventListener("pointerleave", () => {
    mark(null);
    hint.hidden = true;
  });

  // The drawing that is asked about from now on; null: none.
  hlr.hoverOver = (drawing) => {
    mark(null);
    hint.hidden = true;
    svg = drawing;
    parts = drawing ? hlr.partsOf(drawing) : new Map();
  };
}
