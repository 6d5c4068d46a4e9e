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
/* The plotting library is inflated when a chart is first needed; the page's policy knows its digest. */
TV.plotly = function () {
  if (!TV.plotlyLoaded) {
    const packed = document.getElementById("plotly");
    TV.plotlyLoaded = TV.inflate(packed.textContent).then((text) => {
      const script = document.createElement("script");
      script.textContent = text;
      document.head.append(script);
      script.remove();
      packed.remove();
      return window.Plotly;
    });
  }
  return TV.plotlyLoaded;
};
/* Run something once an element comes near the window. */
TV.near = function (element, run) {
  if (!element) { return; }
  const watch = new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) { watch.disconnect(); run(); }
  }, { rootMargin: "400px 0px" });
  watch.observe(element);
};
TV.color = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
TV.dark = window.matchMedia("(prefers-color-scheme: dark)");
/* Black lines are drawn in the ink of the page, so that they are seen on a dark one. */
TV.ink = (color) => (color === "#000000" ? TV.color("ink") : color);
TV.layout = function (extra) {
  return Object.assign({
    font: { family: getComputedStyle(document.body).fontFamily, size: 13, color: TV.color("ink") },
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", margin: { l: 62, r: 12, t: 34, b: 44 },
    legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom" }, modebar: { orientation: "v" },
    hoverlabel: { font: { size: 12, color: TV.color("ink") }, bgcolor: TV.color("paper"), bordercolor: TV.color("rule") },
  }, extra);
};
TV.axis = function (title, extra) {
  return Object.assign({ title: { text: title, standoff: 8, font: { size: 12 } }, showline: true, linecolor: TV.color("muted"), ticks: "outside",
    tickcolor: TV.color("muted"), gridcolor: TV.color("rule"), zeroline: true, zerolinecolor: TV.color("muted"), automargin: true }, extra);
};
/* Ticks at 1, 2 and 5 times powers of ten, written out. */
TV.logTicks = function (low, high) {
  const values = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    for (const digit of [1, 2, 5]) { values.push(Number((digit * Math.pow(10, power)).toPrecision(3))); }
  }
  return { tickvals: values, ticktext: values.map(String), range: [Math.log10(low), Math.log10(high)] };
};
/* A finger on a chart scrolls the page; the tool bar still zooms. */
TV.coarse = window.matchMedia("(pointer: coarse)").matches;
TV.config = { displaylogo: false, responsive: true, showSendToCloud: false, plotlyServerURL: "",
  modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "sendChartToCloud"],
  toImageButtonOptions: { format: "svg" }, locale: "en" };
TV.draw = async function (id, traces, layout) {
  const plotly = await TV.plotly();
  await plotly.react(id, traces, layout, TV.config);
};
