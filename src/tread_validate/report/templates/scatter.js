/* Predicted against reference on logarithmic axes, with the line of no error, the bias and two standard deviations. */
"use strict";
TV.scatter = (function () {
  async function draw() {
    const chosen = (await TV.load("scatter"))[Number(document.getElementById("scatter-quantity").value)];
    const traces = [];
    const all = chosen.series.flatMap((series) => series.x.concat(series.y));
    let ticks = {};
    if (all.length) {
      const low = 0.85 * Math.min(...all), high = 1.18 * Math.max(...all);
      ticks = TV.logTicks(low, high);
      const line = (factor, name, style) => ({ type: "scatter", mode: "lines", x: [low, high], y: [factor * low, factor * high],
        name, legendgroup: name, showlegend: name === "equal", line: style, hoverinfo: "skip" });
      if (chosen.reference) {
        const own = Math.exp(2 * chosen.reference);
        for (const factor of [own, 1 / own]) { traces.push(line(factor, "reference 2σ", { color: TV.color("muted"), width: 1, dash: "dot" })); }
      }
      traces.push(line(1, "equal", { color: TV.color("ink"), width: 1 }));
      for (const series of chosen.series) {
        if (series.bias !== null) {
          traces.push(line(series.bias, series.label, { color: series.color, width: 1.6, dash: "dash" }));
          if (series.sigma !== null) {
            const spread = Math.exp(2 * series.sigma);
            traces.push({ type: "scatter", mode: "lines", fill: "toself", hoverinfo: "skip", line: { width: 0 },
              fillcolor: series.color + "33", name: series.label, legendgroup: series.label, showlegend: false,
              x: [low, high, high, low], y: [low * series.bias * spread, high * series.bias * spread, high * series.bias / spread, low * series.bias / spread] });
          }
        }
      }
    }
    for (const series of chosen.series) {
      traces.push({ type: "scatter", mode: "markers", x: series.x, y: series.y, text: series.labels, customdata: series.ids, name: series.label, legendgroup: series.label,
        marker: { color: series.color, symbol: series.symbol, size: 8, line: { color: "#fff", width: 0.8 } },
        hovertemplate: "%{text}<br>reference %{x:.4g}, predicted %{y:.4g}<extra>%{fullData.name}</extra>" });
    }
    const layout = TV.layout({ hovermode: "closest", dragmode: TV.coarse ? false : "zoom", height: 560,
      xaxis: TV.axis("reference, " + chosen.unit, Object.assign({ type: "log" }, ticks)),
      yaxis: TV.axis("predicted, " + chosen.unit, Object.assign({ type: "log" }, ticks)) });
    if (!all.length) {
      layout.annotations = [{ text: "no current reference to compare with", showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0.5 }];
      layout.xaxis = TV.axis("reference, " + chosen.unit); layout.yaxis = TV.axis("predicted, " + chosen.unit);
    }
    return TV.draw("scatter-plot", traces, layout);
  }
  function start() {
    const select = document.getElementById("scatter-quantity");
    if (!select) { return; }
    const plot = document.getElementById("scatter-plot");
    let seen = false;
    const redraw = () => { if (seen) { draw(); } };
    select.addEventListener("change", redraw);
    TV.dark.addEventListener("change", redraw);
    TV.near(plot, async () => {
      seen = true;
      await draw();
      plot.on("plotly_click", (event) => {
        const id = event.points[0].customdata;
        if (id) { location.hash = "case=" + id; }
      });
    });
  }
  return { start };
})();
