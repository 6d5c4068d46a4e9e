/* Line and point charts as SVG: panels above each other over one x axis, every series in the legend once.
   A few hundred elements and no library: stepping through a study then leaves little to the garbage collector, colours
   follow the page's, and what is saved is what is drawn. */
"use strict";
TV.chart = (function () {
  const DASHES = { dash: "9 4", dot: "2 3", dashdot: "9 3 2 3", longdash: "14 4", longdashdot: "14 3 2 3 2 3" };
  const SYMBOLS = {
    circle: "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z", square: "M-3.6 -3.6H3.6V3.6H-3.6z", diamond: "M0 -5L5 0L0 5L-5 0z",
    "triangle-up": "M0 -4.6L4.6 3.6H-4.6z", "triangle-down": "M0 4.6L4.6 -3.6H-4.6z",
    cross: "M-1.5 -4.5H1.5V-1.5H4.5V1.5H1.5V4.5H-1.5V1.5H-4.5V-1.5H-1.5z",
    x: "M-4.3 -2.2L-2.2 -4.3L0 -2.1L2.2 -4.3L4.3 -2.2L2.1 0L4.3 2.2L2.2 4.3L0 2.1L-2.2 4.3L-4.3 2.2L-2.1 0z",
    star: "M0 -5L1.2 -1.6H4.8L1.9 0.6L3 4L0 1.9L-3 4L-1.9 0.6L-4.8 -1.6H-1.2z",
  };
  const LEFT = 62, RIGHT = 14, BOTTOM = 46, ROW = 20, SIZE = 12;
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = SIZE + "px sans-serif";

  function svg(name, attributes, ...children) {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) { if (value !== null && value !== undefined) { node.setAttribute(key, value); } }
    node.append(...children);
    return node;
  }
  const label = (x, y, text, extra) => svg("text", Object.assign({ x, y, fill: "var(--ink)", "font-size": SIZE }, extra), text);
  const middle = { "text-anchor": "middle" };
  const written = (value) => String(value).replace("-", "−");
  const stroke = (color) => (color === "#000000" ? "var(--ink)" : color);

  /* from values to pixels, linear or logarithmic */
  function scale(domain, range, log) {
    const form = log ? Math.log10 : (value) => value;
    const low = form(domain[0]), factor = (range[1] - range[0]) / (form(domain[1]) - low || 1);
    const at = (value) => range[0] + (form(value) - low) * factor;
    at.back = (pixel) => { const value = low + (pixel - range[0]) / factor; return log ? Math.pow(10, value) : value; };
    return at;
  }
  /* 1, 2 and 5 times powers of ten within the domain */
  function ticks([low, high], count, log) {
    const found = [];
    if (log) {
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
        for (const digit of [1, 2, 5]) { found.push(Number((digit * Math.pow(10, power)).toPrecision(3))); }
      }
      return found.filter((value) => value >= low && value <= high);
    }
    const rough = (high - low) / count || 1, power = Math.pow(10, Math.floor(Math.log10(rough)));
    const step = [1, 2, 5, 10].map((digit) => digit * power).find((size) => size >= 0.999 * rough);
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) { found.push(Number((i * step).toPrecision(12))); }
    return found;
  }
  /* the values' range with a margin; over the part of x that is seen, so that nothing drawn is cut off */
  function extent(traces, view, pad) {
    let low = Infinity, high = -Infinity;
    for (const trace of traces) {
      trace.y.forEach((y, i) => {
        if (view && (trace.x[i] < view[0] || trace.x[i] > view[1])) { return; }
        low = Math.min(low, y); high = Math.max(high, y);
      });
    }
    if (low > high) { return [0, 1]; }
    const room = pad * (high - low || Math.abs(high) || 1);
    return [low - room, high + room];
  }

  /* keys in rows above the panels; returns them and where they end */
  function legend(traces, hidden, width) {
    const group = svg("g", {}), first = new Map();
    for (const trace of traces) { if (!first.has(trace.name) && !trace.quiet) { first.set(trace.name, trace); } }
    let x = 4, y = 14;
    for (const trace of first.values()) {
      const wide = 46 + 1.08 * pen.measureText(trace.name).width, off = hidden.has(trace.name);
      if (x > 4 && x + wide > width) { x = 4; y += ROW; }
      const sample = trace.symbol
        ? svg("path", { d: SYMBOLS[trace.symbol], fill: trace.color, transform: `translate(${x + 14} ${y - 4})` })
        : svg("path", { d: `M${x} ${y - 4}h28`, stroke: stroke(trace.color), "stroke-width": trace.width, "stroke-dasharray": DASHES[trace.dash] });
      group.append(svg("g", { class: "key", role: "button", tabindex: 0, "aria-pressed": String(!off), "aria-label": "Show " + trace.name,
        "data-name": trace.name, opacity: off ? 0.45 : null }, svg("path", { d: `M${x - 3} ${y - 15}h${wide}v${ROW - 1}h${-wide}z`, fill: "transparent" }), sample, label(x + 34, y, trace.name)));
      x += wide + 8;
    }
    return [group, first.size ? y + 12 : 6];
  }
  function across(box, at, domain, spec) {
    const group = svg("g", {});
    for (const value of ticks(domain, Math.max(3, box.width / 90), spec.x.log)) {
      const x = at(value).toFixed(1);
      group.append(svg("path", { d: `M${x} ${box.top}V${box.bottom}`, stroke: "var(--rule)" }), label(x, box.bottom + 17, written(value), middle));
    }
    group.append(label(box.left + box.width / 2, box.bottom + 37, spec.x.title, middle));
    return group;
  }
  function upright(box, at, domain, panel) {
    const group = svg("g", {}), half = (box.top + box.bottom) / 2;
    for (const value of panel.ticks || ticks(domain, Math.max(2, (box.bottom - box.top) / 45), panel.log)) {
      const y = Number(at(value).toFixed(1));
      group.append(svg("path", { d: `M${box.left} ${y}h${box.width}`, stroke: value === 0 ? "var(--muted)" : "var(--rule)" }),
        label(box.left - 7, y + 4, written(value), { "text-anchor": "end" }));
    }
    group.append(svg("path", { d: `M${box.left} ${box.top}V${box.bottom}h${box.width}`, stroke: "var(--muted)", fill: "none" }),
      label(14, half, panel.title, Object.assign({ transform: `rotate(-90 14 ${half})` }, middle)));
    return group;
  }
  function curve(trace, x, y) {
    if (trace.symbol) {
      return svg("g", { fill: trace.color, stroke: "var(--paper)", "stroke-width": 0.8 }, ...trace.x.map((value, i) =>
        svg("path", { d: SYMBOLS[trace.symbol], transform: `translate(${x(value).toFixed(1)} ${y(trace.y[i]).toFixed(1)})` })));
    }
    const points = trace.x.map((value, i) => `${x(value).toFixed(1)} ${y(trace.y[i]).toFixed(1)}`);
    return svg("path", { d: points.length ? "M" + points.join("L") : "", fill: trace.filled ? trace.color : "none", "fill-opacity": trace.filled ? 0.18 : null,
      stroke: trace.filled ? "none" : stroke(trace.color), "stroke-width": trace.width, "stroke-dasharray": DASHES[trace.dash], "stroke-linejoin": "round" });
  }

  /* Draw `spec`: {height, x: {title, log}, panels: [{title, share, range, ticks, log}], traces, empty}; a trace has name,
     x, y, panel and the look. Returns the drawing, its panels' boxes and scales. */
  function paint(host, spec, view, hidden) {
    const width = Math.max(host.clientWidth, 280), shown = spec.traces.filter((trace) => !hidden.has(trace.name));
    const [keys, top] = legend(spec.traces, hidden, width), low = spec.height - BOTTOM;
    const domain = view || spec.x.range || extent(shown.map((trace) => ({ x: trace.x, y: trace.x })), null, 0);
    const whole = { left: LEFT, width: width - LEFT - RIGHT, top, bottom: low };
    const x = scale(domain, [LEFT, LEFT + whole.width], spec.x.log), panels = [], gap = 16;
    const drawing = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width, height: spec.height, viewBox: `0 0 ${width} ${spec.height}`, "font-family": "sans-serif" },
      keys, across(whole, x, domain, spec));
    let start = top;
    const room = low - top - gap * (spec.panels.length - 1);
    spec.panels.forEach((panel, index) => {
      const box = { left: LEFT, width: whole.width, top: start, bottom: start + panel.share * room }, own = shown.filter((trace) => (trace.panel || 0) === index);
      const range = (spec.square && view) || panel.range || extent(own, view, 0.05), y = scale(range, [box.bottom, box.top], panel.log);
      const clip = `${host.id}-${index}`;
      drawing.append(svg("clipPath", { id: clip }, svg("rect", { x: LEFT, y: box.top - 1, width: whole.width, height: box.bottom - box.top + 2 })),
        upright(box, y, range, panel), svg("g", { "clip-path": `url(#${clip})` }, ...own.map((trace) => curve(trace, x, y))));
      panels.push({ box, y, own });
      start = box.bottom + gap;
    });
    if (spec.empty) { drawing.append(label(width / 2, (top + low) / 2, spec.empty, middle)); }
    return { drawing, panels, x, whole };
  }

  /* The drawing as a file of its own: in the colours of print, whatever the page's are. */
  function text(host) {
    const printed = { ink: "#1b1f24", muted: "#57606a", rule: "#d5dae0", paper: "#ffffff" };
    const copy = host.querySelector("svg").cloneNode(true);
    copy.querySelectorAll(".cursor").forEach((node) => node.remove());
    return new XMLSerializer().serializeToString(copy).replace(/var\(--([a-z]+)\)/g, (_, name) => printed[name]);
  }
  return { svg, paint, text };
})();
