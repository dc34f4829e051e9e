"use strict";
// What all scripts of the page share. They are plain scripts, not modules: a browser loads no modules from disk.

const hlr = {};

// The element of the page that has this attribute.
hlr.part = (name, within = document) => within.querySelector(`[data-${name}]`);

// A new element with text. Text never becomes markup.
hlr.make = (tag, text = "", attributes = {}) => {
  const element = document.createElement(tag);
  element.textContent = text;
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
};
