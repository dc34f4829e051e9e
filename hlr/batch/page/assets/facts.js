"use strict";
// What is told of a drawing beside it: notes, what changed, facts, times, files.

{
  const section = (title, ...content) => {
    const element = hlr.make("section");
    element.append(hlr.make("h3", title), ...content);
    return element;
  };

  const table = (rows) => {
    const list = hlr.make("dl");
    for (const [name, value] of rows) list.append(hlr.make("dt", name), hlr.make("dd", value));
    return list;
  };

  const notes = (rows) => {
    const list = hlr.make("ul", "", { class: "notes" });
    for (const [text, warning] of rows) list.append(hlr.make("li", text, { class: warning ? "warned" : "" }));
    return list;
  };

  // The total first, then the stages, the slowest first.
  const times = (seconds) => {
    const stages = Object.entries(seconds).filter(([name]) => name !== "total");
    stages.sort(([, one], [, other]) => other - one);
    const rows = "total" in seconds ? [["total", seconds.total], ...stages] : stages;
    return table(rows.map(([name, value]) => [name, `${value.toFixed(3)} s`]));
  };

  const files = (rows) => {
    const list = hlr.make("p", "", { class: "files" });
    for (const [format, address] of rows) list.append(hlr.make("a", format.toUpperCase(), { href: address }), " ");
    return list;
  };

  hlr.factsOf = (drawing) => {
    const sections = [];
    if (drawing.change) sections.push(section("Baseline", hlr.make("p", drawing.change.summary || drawing.change.state)));
    if (drawing.notes?.length) sections.push(section("Notes", notes(drawing.notes)));
    if (drawing.facts?.length) sections.push(section("Drawing", table(drawing.facts)));
    if (Object.keys(drawing.seconds ?? {}).length) sections.push(section("Times", times(drawing.seconds)));
    if (drawing.files) sections.push(section("Files", files(drawing.files)));
    return sections;
  };
}
