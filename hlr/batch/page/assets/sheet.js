"use strict";
// The contact sheet: which cards are shown, in which order, and moving among them.

{
  const sheet = hlr.part("sheet");
  const planned = [...sheet.children];
  const search = hlr.part("search");

  // What a search looks through: names, views, errors and notes.
  const words = new Map();
  for (const each of hlr.batch) {
    words.set(each.key, [each.name, each.error, ...(each.notes ?? []).map(([text]) => text)].join("\n").toLowerCase());
  }

  const orders = {
    plan: null,
    slowest: (one, other) => other.dataset.seconds - one.dataset.seconds,
    name: (one, other) => (words.get(one.dataset.key) < words.get(other.dataset.key) ? -1 : 1),
  };

  const state = () => document.querySelector("[data-filter]:checked").value;

  const filter = () => {
    const wanted = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const asked = state();
    let count = 0;
    for (const card of planned) {
      const { key, state: own, change } = card.dataset;
      const text = words.get(key);
      card.hidden = !((!asked || asked === own || asked === change) && wanted.every((word) => text.includes(word)));
      count += !card.hidden;
    }
    hlr.part("count").textContent = `${count} of ${planned.length} shown`;
    hlr.part("none").hidden = count > 0;
  };

  const order = () => {
    const by = orders[hlr.part("order").value];
    sheet.append(...(by ? [...planned].sort(by) : planned));
  };

  search.addEventListener("input", filter);
  hlr.part("order").addEventListener("change", order);
  for (const each of document.querySelectorAll("[data-filter]")) each.addEventListener("change", filter);

  // The keys of the cards that are shown, in their order.
  hlr.shownKeys = () => [...sheet.children].filter((card) => !card.hidden).map((card) => card.dataset.key);

  hlr.cardOf = (key) => planned.find((card) => card.dataset.key === key);

  // Move the focus from card to card: by one, or by a row.
  hlr.moveAmongCards = (arrow) => {
    const cards = [...sheet.children].filter((card) => !card.hidden);
    if (!cards.length) return;
    const here = cards.indexOf(document.activeElement.closest(".card"));
    const top = cards[0].offsetTop;
    const columns = Math.max(1, cards.findIndex((card) => card.offsetTop > top));
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns }[arrow];
    const there = here < 0 ? 0 : Math.min(cards.length - 1, Math.max(0, here + step));
    cards[there].querySelector("a").focus();
  };

  // A browser may have kept what was typed before the page was loaded anew.
  if (search.value || state()) filter();
  if (hlr.part("order").value !== "plan") order();
}
