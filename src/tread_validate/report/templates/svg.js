/* A drawing with one path for every text instead of an element a letter: a browser keeps kilobytes for each element. */
"use strict";
TV.joined = function (svg) {
  const glyphs = new Map();
  for (const [, name, outline, scale] of svg.matchAll(/<path id="([^"]+)"(?: d="([^"]*)")? transform="scale\(([0-9.]+)\)"\/>/g)) {
    glyphs.set(name, [outline || "", Number(scale)]);
  }
  const place = /<use xlink:href="#([^"]+)"(?: transform="translate\(([-0-9.]+) ([-0-9.]+)\)(?: scale\(([0-9.]+)\))?")?\/>/g;
  return svg.replace(/<g( [^>]*transform=[^>]*)>\s*(?:<defs>[^]*?<\/defs>\s*)?((?:<use xlink:href="#[^>]*\/>\s*)+)<\/g>/g, (whole, attributes, uses) => {
    let line = "";
    for (const [, name, x, y, size] of uses.matchAll(place)) {
      if (!glyphs.has(name)) { return whole; }
      const [outline, scale] = glyphs.get(name), factor = scale * Number(size || 1);
      line += outline.replace(/(-?[0-9.]+) (-?[0-9.]+)/g, (pair, across, up) =>
        (factor * across + Number(x || 0)).toFixed(1) + " " + (factor * up + Number(y || 0)).toFixed(1));
    }
    return line ? "<path" + attributes + ' d="' + line + '"/>' : "";
  });
};
