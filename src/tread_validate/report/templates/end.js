"use strict";
const wide = window.matchMedia("(min-width: 1081px)");
const contents = document.querySelector("nav.contents details");
contents.open = wide.matches;
wide.addEventListener("change", () => { contents.open = wide.matches; });
TV.sortTables(document);
TV.filterTables(document);
TV.scrollRegions(document);
TV.figures.start();
TV.browser.start();
TV.heatmap.start();
TV.scatter.start();
/* A link to something inside a folded part opens it. */
window.addEventListener("hashchange", () => {
  const target = document.getElementById(location.hash.slice(1));
  const folded = target && target.closest("details");
  if (folded) { folded.open = true; target.scrollIntoView(); }
});
/* A folded table is inflated when it is opened. */
for (const item of document.querySelectorAll("details.folded")) {
  item.addEventListener("toggle", async () => {
    const packed = TV.data.tables[item.dataset.table];
    if (!item.open || !packed) { return; }
    delete TV.data.tables[item.dataset.table];
    item.insertAdjacentHTML("beforeend", await TV.inflate(packed));
    TV.sortTables(item); TV.filterTables(item); TV.scrollRegions(item);
  });
}
/* Charts drawn for the screen are redrawn at the paper's width before printing. */
const charts = (size) => { if (window.Plotly) { document.querySelectorAll(".js-plotly-plot").forEach((plot) => Plotly.relayout(plot, size)); } };
window.addEventListener("beforeprint", () => { TV.figures.all(); charts({ width: 640 }); });
window.addEventListener("afterprint", () => charts({ width: null, autosize: true }));
document.documentElement.dataset.ready = "yes";
