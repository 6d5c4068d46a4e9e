"use strict";
TV.sortTables();
TV.browser.start();
TV.heatmap.start();
TV.scatter.start();
/* Charts drawn for the screen are redrawn at the paper's width before printing. */
window.addEventListener("beforeprint", () => document.querySelectorAll(".js-plotly-plot").forEach((plot) => Plotly.relayout(plot, { width: 640 })));
window.addEventListener("afterprint", () => document.querySelectorAll(".js-plotly-plot").forEach((plot) => Plotly.relayout(plot, { width: null, autosize: true })));
document.documentElement.dataset.ready = "yes";
