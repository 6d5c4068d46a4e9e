/* Error heat maps: the cells are links drawn by the report; this fills them for the chosen quantity and model. */
"use strict";
TV.heatmap = (function () {
  /* white at no error, blue below, orange above: told apart by every common colour vision */
  function colour(share) {
    const clipped = Math.max(-1, Math.min(1, share));
    const end = clipped < 0 ? [47, 127, 181] : [217, 102, 43];
    return "rgb(" + end.map((channel) => Math.round(255 + (channel - 255) * Math.abs(clipped))).join(",") + ")";
  }
  function draw() {
    const chosen = TV.data.heat[Number(document.getElementById("heat-quantity").value)];
    for (const link of document.querySelectorAll("a.heat-cell")) {
      const cell = chosen.cells[link.dataset.case];
      link.textContent = cell ? cell[0] : "n/a";
      link.style.background = cell ? colour(cell[1]) : "";
      link.setAttribute("aria-label", link.dataset.label + ": " + (cell ? cell[0] : "no value"));
    }
    document.getElementById("heat-low").textContent = chosen.lowText;
    document.getElementById("heat-high").textContent = chosen.highText;
  }
  function start() {
    const select = document.getElementById("heat-quantity");
    if (!select) { return; }
    select.addEventListener("change", draw);
    draw();
  }
  return { start };
})();
