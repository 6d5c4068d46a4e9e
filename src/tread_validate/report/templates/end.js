"use strict";
TV.sortTables();
TV.browser.start();
TV.heatmap.start();
TV.scatter.start();
/* Folded tables are opened, and charts drawn for the screen redrawn at the paper's width, before printing. */
const folded = Array.from(document.querySelectorAll("details:not([open])"));
window.addEventListener("beforeprint", () => folded.forEach((item) => { item.open = true; }));
window.addEventListener("afterprint", () => folded.forEach((item) => { item.open = false; }));
window.addEventListener("beforeprint", () => document.querySelectorAll(".js-plotly-plot").forEach((plot) => Plotly.relayout(plot, { width: 640 })));
window.addEventListener("afterprint", () => document.querySelectorAll(".js-plotly-plot").forEach((plot) => Plotly.relayout(plot, { width: null, autosize: true })));
document.documentElement.dataset.ready = "yes";
