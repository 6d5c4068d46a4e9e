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
/* Every figure is drawn before printing. */
window.addEventListener("beforeprint", () => { TV.figures.all(); });
document.documentElement.dataset.ready = "yes";
