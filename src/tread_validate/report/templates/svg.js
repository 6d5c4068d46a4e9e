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
/* A drawing as a part of the page: in the page's colours, so that it is dark where the page is, and without what only a
   file of its own needs. Comments and names of parts go too: they would be elements and anchors of the page. */
TV.themed = function (svg, key) {
  const colors = { "#000000": "ink", "#57606a": "muted", "#e6e9ec": "rule", "#ffffff": "paper", "#6b5200": "warn" };
  const bare = TV.joined(svg)
    .replace(/^[^]*?(?=<svg )/, "").replace(/<!--[^]*?-->/g, "").replace(/<metadata>[^]*?<\/metadata>/g, "")
    .replace(/<style [^]*?<\/style>/g, "").replace(/ id="[A-Za-z0-9.]+_[0-9]+"/g, "")
    .replace(/ id="|url\(#|href="#/g, (start) => start + key + "-")
    .replace(/#(?:000000|57606a|e6e9ec|ffffff|6b5200)\b/g, (color) => `var(--${colors[color]})`)
    .replace(/^<svg [^>]*?width="([0-9.]+)pt" height="([0-9.]+)pt"/, '<svg class="drawn" stroke-linejoin="round" fill="var(--ink)" width="$1" height="$2"')
    .replace(/>\s+</g, "><");
  return bare.replace(/<g>(<(?:path|use)[^>]*\/>)<\/g>/g, "$1").replace(/<g>((?:<path[^>]*\/>)*)<\/g>/g, "$1").replace(/<g><\/g>/g, "");
};
