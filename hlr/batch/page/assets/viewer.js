"use strict";
// The viewer: one drawing on a stage. The address says which: "#" and its key, so that a link leads to a drawing.

{
  const viewer = hlr.part("viewer");
  const paper = hlr.part("paper");
  const message = hlr.part("message");
  const side = hlr.part("facts");
  const drawings = new Map(hlr.batch.map((each) => [each.key, each]));
  let shown = null;

  const say = (text) => {
    message.textContent = text;
    message.hidden = !text;
  };

  const pictureOf = async (drawing) => {
    const image = hlr.make("img", "", { src: drawing.picture, alt: "" });
    await image.decode();
    return image;
  };

  const contentOf = (drawing) => (drawing.svg ? hlr.drawingOf(drawing.key) : pictureOf(drawing));

  const fill = async (drawing) => {
    if (drawing.error || !drawing.picture) {
      say(drawing.error || "None of its formats can be shown here: add svg to the formats.");
      return;
    }
    say("Loading …");
    let content;
    try {
      content = await contentOf(drawing);
    } catch (error) {
      if (shown === drawing.key) say(`The drawing cannot be shown: ${error.message}.`);
      return;
    }
    if (shown !== drawing.key) return; // another one was asked for meanwhile
    say("");
    content.classList.add("after");
    paper.append(content);
    hlr.offerChange(drawing.change);
    if (drawing.svg) {
      side.prepend(...hlr.layersOf(content));
      hlr.hoverOver(content);
    }
    hlr.zoom.fit();
    viewer.dataset.ready = drawing.key;
  };

  const empty = () => {
    hlr.hoverOver(null);
    paper.replaceChildren();
    side.replaceChildren();
    hlr.offerChange(null);
    delete viewer.dataset.ready;
  };

  const open = (key) => {
    const drawing = drawings.get(key);
    shown = key;
    empty();
    hlr.part("title").textContent = drawing.name;
    side.append(...hlr.factsOf(drawing));
    if (!viewer.open) viewer.showModal();
    fill(drawing);
  };

  const follow = () => {
    const key = location.hash.slice(1);
    if (drawings.has(key)) open(key);
    else if (viewer.open) viewer.close();
  };

  // Show the next drawing of those on the sheet, or the one before.
  hlr.step = (by) => {
    const keys = hlr.shownKeys();
    const next = keys[keys.indexOf(shown) + by];
    if (next) location.replace(`#${next}`);
  };

  hlr.viewing = () => viewer.open;

  hlr.part("close").addEventListener("click", () => viewer.close());
  viewer.addEventListener("close", () => {
    const last = shown;
    shown = null;
    empty();
    if (location.hash.length > 1) location.replace("#");
    hlr.cardOf(last)?.querySelector("a").focus();
  });
  for (const button of viewer.querySelectorAll("[data-step]")) {
    button.addEventListener("click", () => hlr.step(Number(button.dataset.step)));
  }
  window.addEventListener("hashchange", follow);
  window.addEventListener("resize", () => hlr.viewing() && hlr.zoom.fit());
  follow();
}
