"use strict";
// Light or dark: what the system says, or what the reader chose, which this browser remembers.

{
  const choice = hlr.part("theme-choice");

  const remembered = (value) => {
    try {
      if (value !== undefined) localStorage.setItem("hlr-theme", value);
      return localStorage.getItem("hlr-theme") ?? "";
    } catch {
      return value ?? ""; // a browser that keeps nothing
    }
  };

  const show = (value) => {
    document.documentElement.dataset.theme = value;
    choice.value = value;
  };

  choice.addEventListener("change", () => show(remembered(choice.value)));
  show(remembered());
}
