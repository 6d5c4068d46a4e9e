/* The page's data, and the one name all parts share. */
"use strict";
const TV = {};
TV.data = JSON.parse(document.getElementById("data").textContent);
document.getElementById("data").remove();
TV.element = function (name, attributes, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined) { node.setAttribute(key, value); }
  }
  for (const child of children) { node.append(child); }
  return node;
};
/* Bytes out of base64; a plain loop, for a call a byte leaves a hundred times the bytes to the garbage collector. */
TV.bytes = function (packed) {
  const text = atob(packed), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) { bytes[i] = text.charCodeAt(i); }
  return bytes;
};
/* Text out of base64 of a raw deflate stream. */
TV.inflate = async function (packed) {
  const bytes = TV.bytes(packed);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).text();
};
/* Data of a chart, inflated once. */
TV.load = async function (key) {
  if (typeof TV.data[key] === "string") { TV.data[key] = JSON.parse(await TV.inflate(TV.data[key])); }
  return TV.data[key];
};
/* Run something once an element comes near the window. */
TV.near = function (element, run) {
  if (!element) { return; }
  const watch = new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) { watch.disconnect(); run(); }
  }, { rootMargin: "400px 0px" });
  watch.observe(element);
};
