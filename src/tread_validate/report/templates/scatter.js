/* Predicted against reference on logarithmic axes, with the line of no error, the bias and two standard deviations. */
"use strict";
TV.scatter = (function () {
  function lines(chosen, low, high) {
    const line = (factor, name, look, quiet) => Object.assign({ x: [low, high], y: [factor * low, factor * high], name, quiet }, look);
    const found = [];
    if (chosen.reference) {
      const own = Math.exp(2 * chosen.reference), look = { color: "var(--muted)", width: 1, dash: "dot" };
      found.push(line(own, "reference 2σ", look), line(1 / own, "reference 2σ", look, true));
    }
    found.push(line(1, "equal", { color: "var(--ink)", width: 1 }));
    for (const series of chosen.series) {
      if (series.bias === null) { continue; }
      if (series.sigma !== null) {
        const wide = Math.exp(2 * series.sigma), bias = series.bias;
        found.push({ x: [low, high, high, low], y: [low * bias * wide, high * bias * wide, high * bias / wide, low * bias / wide],
          name: series.label, color: series.color, filled: true, quiet: true });
      }
      found.push(line(series.bias, series.label, { color: series.color, width: 1.6, dash: "dash" }, true));
    }
    return found;
  }
  async function draw() {
    const chosen = (await TV.load("scatter"))[Number(document.getElementById("scatter-quantity").value)];
    const all = chosen.series.flatMap((series) => series.x.concat(series.y));
    const range = all.length ? [0.85 * Math.min(...all), 1.18 * Math.max(...all)] : [0, 1], log = all.length > 0;
    const points = chosen.series.map((series) => ({ x: series.x, y: series.y, labels: series.labels, ids: series.ids, name: series.label,
      color: series.color, symbol: series.symbol, unit: chosen.unit }));
    TV.draw("scatter-plot", {
      height: 560, square: true, points: true, x: { title: "reference, " + chosen.unit, log, range }, empty: log ? "" : "no current reference to compare with",
      panels: [{ title: "predicted, " + chosen.unit, share: 1, log, range }], traces: [...(log ? lines(chosen, ...range) : []), ...points],
    }, (id) => { location.hash = "case=" + id; });
  }
  function start() {
    const select = document.getElementById("scatter-quantity");
    if (!select) { return; }
    let seen = false;
    select.addEventListener("change", () => { if (seen) { draw(); } });
    TV.near(document.getElementById("scatter-plot"), () => { seen = true; draw(); });
  }
  return { start };
})();
