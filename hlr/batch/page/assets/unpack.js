"use strict";
// The SVG of a drawing, as elements. Each drawing lies compressed in a script of its own, loaded when it is first shown:
// a page that is opened from disk may read no other file.

{
  const packed = new Map();

  // Called by the script of a drawing.
  hlr.unpack = (key, content) => packed.set(key, content);

  const load = (key) =>
    new Promise((resolve, reject) => {
      const script = hlr.make("script", "", { src: `page/drawings/${key}.js` });
      script.addEventListener("load", resolve);
      script.addEventListener("error", () => reject(new Error(`page/drawings/${key}.js is missing`)));
      document.head.append(script);
    });

  // The drawing as an svg element, which nothing else on the page has.
  hlr.drawingOf = async (key) => {
    if (!packed.has(key)) await load(key);
    const bytes = Uint8Array.from(atob(packed.get(key)), (letter) => letter.charCodeAt(0));
    packed.delete(key); // or every drawing that was looked at would stay in memory
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    const parsed = new DOMParser().parseFromString(await new Response(stream).text(), "image/svg+xml");
    if (parsed.documentElement.localName !== "svg") throw new Error("the SVG cannot be read");
    return document.importNode(parsed.documentElement, true);
  };
}
