"use strict";
// Zoom and pan: wheel, drag, two fingers, buttons. The paper lies on the stage, moved and scaled.

{
  const stage = hlr.part("stage");
  const paper = hlr.part("paper");
  const least = 0.02;
  const most = 200;
  let [scale, x, y] = [1, 0, 0];

  const place = () => {
    paper.style.transform = `translate(${x}px, ${y}px) scale(${scale})`;
    paper.style.setProperty("--zoom", scale);
    hlr.part("percent").textContent = `${Math.round(scale * 100)} %`;
  };

  // Zoom about a point of the stage, which stays where it is.
  const zoom = (factor, atX = stage.clientWidth / 2, atY = stage.clientHeight / 2) => {
    const wanted = Math.min(most, Math.max(least, scale * factor));
    x = atX - ((atX - x) * wanted) / scale;
    y = atY - ((atY - y) * wanted) / scale;
    scale = wanted;
    place();
  };

  const pan = (byX, byY) => {
    x += byX;
    y += byY;
    place();
  };

  // The whole paper, in the middle of the stage.
  const fit = () => {
    const [width, height] = [paper.offsetWidth, paper.offsetHeight];
    if (!width || !height) return;
    scale = Math.max(least, Math.min((stage.clientWidth - 24) / width, (stage.clientHeight - 24) / height, most));
    x = (stage.clientWidth - width * scale) / 2;
    y = (stage.clientHeight - height * scale) / 2;
    place();
  };

  // A point of the paper, in its own pixels, to the middle of the stage, with at least so many pixels around it.
  const look = (atX, atY, around) => {
    scale = Math.max(least, Math.min(Math.min(stage.clientWidth, stage.clientHeight) / around, most));
    x = stage.clientWidth / 2 - atX * scale;
    y = stage.clientHeight / 2 - atY * scale;
    place();
  };

  const actions = { in: () => zoom(1.25), out: () => zoom(0.8), fit };
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", actions[button.dataset.zoom]);
  }

  stage.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { left, top } = stage.getBoundingClientRect();
      const lines = event.deltaMode ? 30 : 1;
      zoom(Math.exp(-event.deltaY * lines * 0.0015), event.clientX - left, event.clientY - top);
    },
    { passive: false },
  );
  stage.addEventListener("dblclick", fit);

  // Fingers, or the mouse with its button down: where each was last.
  const held = new Map();
  const spread = () => {
    const [one, other] = [...held.values()];
    return { gap: Math.hypot(one.x - other.x, one.y - other.y), x: (one.x + other.x) / 2, y: (one.y + other.y) / 2 };
  };

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target.closest("label")) return;
    stage.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  stage.addEventListener("pointermove", (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const before = held.size === 2 ? spread() : null;
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (before) {
      const [now, { left, top }] = [spread(), stage.getBoundingClientRect()];
      pan(now.x - before.x, now.y - before.y);
      if (before.gap) zoom(now.gap / before.gap, now.x - left, now.y - top);
    } else if (held.size === 1) {
      pan(event.clientX - last.x, event.clientY - last.y);
    }
  });
  for (const name of ["pointerup", "pointercancel"]) {
    stage.addEventListener(name, (event) => held.delete(event.pointerId));
  }

  hlr.zoom = { ...actions, look, pan, held: () => held.size > 0 };
}
