"use strict";
// A drawing beside the earlier one: now, before, both with a line between them that is swiped, or one over the other.

{
  const paper = hlr.part("paper");
  const modes = hlr.part("modes");
  const swipe = hlr.part("swipe");
  const slider = swipe.querySelector("input");
  let pictures = {};

  const needs = { after: [], before: ["before"], swipe: ["before"], overlay: ["overlay"] };

  // Both drawings have their true size: one pixel of the screen is as long in each.
  const picture = (name, address) => {
    const image = hlr.make("img", "", { src: address, alt: name === "before" ? "the earlier drawing" : "the difference" });
    image.className = name;
    return image;
  };

  const cut = () => paper.style.setProperty("--swipe", `${slider.value}%`);

  const show = (mode) => {
    paper.dataset.mode = mode;
    swipe.hidden = mode !== "swipe";
    for (const button of modes.children) button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    cut();
  };

  slider.addEventListener("input", cut);
  modes.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button) show(button.dataset.mode);
  });

  // Offer what there is of an earlier drawing.
  hlr.offerChange = (change) => {
    pictures = {};
    for (const name of ["before", "overlay"]) if (change?.[name]) pictures[name] = picture(name, change[name]);
    paper.append(...Object.values(pictures));
    modes.hidden = !Object.keys(pictures).length;
    for (const button of modes.children) {
      button.hidden = !needs[button.dataset.mode].every((name) => name in pictures);
    }
    slider.value = 50;
    show("after");
  };
}
