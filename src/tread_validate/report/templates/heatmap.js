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
    const scale = chosen.limit;
    for (const link of document.querySelectorAll("a.heat-cell")) {
      const value = chosen.values[link.dataset.case];
      const missing = value === undefined || value === null;
      link.textContent = missing ? "n/a" : chosen.relative ? TV.percent(value) : TV.number(value);
      link.style.background = missing ? "" : colour((value - chosen.centre) / scale);
      link.setAttribute("aria-label", link.dataset.label + ": " + (missing ? "no value" : link.textContent));
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
