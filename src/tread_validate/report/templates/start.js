/* The page's data, and the one name all parts share. */
"use strict";
const TV = {};
TV.data = JSON.parse(document.getElementById("data").textContent);
TV.element = function (name, attributes, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined) { node.setAttribute(key, value); }
  }
  for (const child of children) { node.append(child); }
  return node;
};
TV.layout = function (extra) {
  return Object.assign({
    font: { family: getComputedStyle(document.body).fontFamily, size: 13, color: "#1b1f24" },
    paper_bgcolor: "#fff", plot_bgcolor: "#fff", margin: { l: 62, r: 12, t: 34, b: 44 },
    legend: { orientation: "h", x: 0, y: -0.13, yanchor: "top" }, hoverlabel: { font: { size: 12 } },
  }, extra);
};
TV.axis = function (title, extra) {
  return Object.assign({ title: { text: title, standoff: 8 }, showline: true, linecolor: "#57606a", ticks: "outside", tickcolor: "#57606a",
    gridcolor: "#e6e9ec", zeroline: true, zerolinecolor: "#9aa3ab", automargin: true }, extra);
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
