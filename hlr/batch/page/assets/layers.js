"use strict";
// Layers on and off: visible and hidden lines, classes of lines, parts. Each layer is a selector of groups in the SVG.

{
  // Names of the parts by their number, as the SVG has them.
  hlr.partsOf = (svg) => {
    const names = new Map();
    for (const part of svg.getElementsByTagNameNS("*", "part")) names.set(part.getAttribute("index"), part.getAttribute("name"));
    for (const group of svg.querySelectorAll("[data-part]")) {
      const index = group.dataset.part;
      if (!names.has(index)) names.set(index, `part ${index}`);
    }
    return names;
  };

  const present = (svg, rows) => rows.filter(([, selector]) => svg.querySelector(selector));

  const classesOf = (svg) => {
    const groups = svg.querySelectorAll("g.visible > g[class], g.hidden > g[class]");
    return [...new Set([...groups].map((group) => group.getAttribute("class")))].sort();
  };

  const box = (text, change) => {
    const label = hlr.make("label");
    const input = hlr.make("input", "", { type: "checkbox" });
    input.checked = true;
    input.addEventListener("change", () => change(input.checked));
    label.append(input, hlr.make("span", text));
    return label;
  };

  const switchOf = (svg, [name, selector]) =>
    box(name, (on) => {
      for (const group of svg.querySelectorAll(selector)) group.style.display = on ? "" : "none";
    });

  // A group of switches; where there are many, one for all.
  const groupOf = (svg, title, rows) => {
    const group = hlr.make("fieldset");
    group.append(hlr.make("legend", title));
    const list = hlr.make("div", "", { class: "switches" });
    list.append(...rows.map((row) => switchOf(svg, row)));
    if (rows.length > 2) {
      group.append(
        box("all", (on) => {
          for (const input of list.querySelectorAll("input")) if (input.checked !== on) input.click();
        }),
      );
    }
    group.append(list);
    return group;
  };

  // Switches for all layers of a drawing.
  hlr.layersOf = (svg) => {
    const groups = [
      [
        "Lines",
        present(svg, [
          ["visible", "g.visible"],
          ["hidden", "g.hidden"],
          ["faces", "#fill"],
          ["sheet", "#template"],
        ]),
      ],
      ["Classes", classesOf(svg).map((name) => [name, `g.${CSS.escape(name)}`])],
      ["Parts", [...hlr.partsOf(svg)].map(([index, name]) => [name, `[data-part="${CSS.escape(index)}"]`])],
    ];
    return groups.filter(([, rows]) => rows.length).map(([title, rows]) => groupOf(svg, title, rows));
  };
}
