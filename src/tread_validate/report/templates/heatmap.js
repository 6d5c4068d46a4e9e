/* Error heat maps: the cells are links drawn by the report; this fills them for the chosen quantity and model. */
"use strict";
TV.heatmap = (function () {
  /* white at no error, blue below, orange above: told apart by every common colour vision */
  function colour(share) {
    const clipped = Math.max(-1, Math.min(1, share));
    const end = clipped < 0 ? [128, 184, 222] : [242, 156, 104];
    return "rgb(" + end.map((channel) => Math.round(255 + (channel - 255) * Math.abs(clipped))).join(",") + ")";
  }
  async function draw() {
    const chosen = (await TV.load("heat"))[Number(document.getElementById("heat-quantity").value)];
    for (const link of document.querySelectorAll("a.heat-cell")) {
      const cell = chosen.cells[link.dataset.case];
      link.textContent = cell ? cell[0] : "n/a";
      link.style.background = cell ? colour(cell[1]) : "";
      link.setAttribute("aria-label", link.dataset.label + ": " + (cell ? cell[0] : "no value"));
    }
    document.getElementById("heat-low").textContent = chosen.lowText;
    document.getElementById("heat-high").textContent = chosen.highText;
  }
  /* one stop of the Tab key for all cells; arrow keys move along rows and columns */
  function rove(cells) {
    cells.forEach((cell, index) => { cell.tabIndex = index ? -1 : 0; });
    const steps = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };
    const facets = document.querySelector(".facets");
    facets.addEventListener("keydown", (event) => {
      const step = steps[event.key], from = event.target.closest("a.heat-cell");
      if (!step || !from) { return; }
      const box = from.getBoundingClientRect();
      const ahead = (cell) => {
        const other = cell.getBoundingClientRect();
        const along = step[0] ? step[0] * (other.x - box.x) : step[1] * (other.y - box.y);
        const aside = step[0] ? Math.abs(other.y - box.y) : Math.abs(other.x - box.x);
        return along > 1 ? along + 8 * aside : Infinity;
      };
      const next = cells.reduce((best, cell) => (ahead(cell) < ahead(best) ? cell : best), from);
      if (next === from) { return; }
      event.preventDefault();
      from.tabIndex = -1; next.tabIndex = 0; next.focus();
    });
  }
  function start() {
    const select = document.getElementById("heat-quantity");
    if (!select) { return; }
    select.addEventListener("change", draw);
    draw();
    rove(Array.from(document.querySelectorAll("a.heat-cell")));
  }
  return { start };
})();
