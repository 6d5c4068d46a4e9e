/* What a reader does with a chart: values under the pointer or the arrow keys, zoom along x, series on and off. */
"use strict";
TV.draw = (function () {
  const states = new Map();
  const value = (number) => String(Number(number.toPrecision(4))).replace("-", "−");

  /* Show `spec` in an element; `pick` is called with the id of a point that is clicked. */
  function draw(id, spec, pick) {
    const host = document.getElementById(id);
    let state = states.get(host);
    if (!state) {
      state = { host, hidden: new Set(), tip: TV.element("div", { class: "tip", "aria-hidden": "true" }) };
      states.set(host, state);
      listen(state);
    }
    Object.assign(state, { spec, pick, view: null });
    host.data = spec.traces;
    host.spec = spec;
    show(state);
  }
  function show(state) {
    const { host, spec } = state, focused = document.activeElement && host.contains(document.activeElement) && document.activeElement.dataset.name;
    Object.assign(state, TV.chart.paint(host, spec, state.view, state.hidden), { at: null });
    state.width = host.clientWidth;
    state.tip.hidden = true;
    const parts = [state.drawing, state.tip];
    if (state.view) {
      const whole = TV.element("button", { type: "button", class: "whole" }, "Show all");
      whole.addEventListener("click", () => { state.view = null; show(state); });
      parts.push(whole);
    }
    host.replaceChildren(...parts);
    if (focused) { Array.from(host.querySelectorAll(".key")).find((key) => key.dataset.name === focused).focus(); }
  }

  function nearest(xs, x) {
    let best = 0;
    xs.forEach((other, i) => { if (Math.abs(other - x) < Math.abs(xs[best] - x)) { best = i; } });
    return best;
  }
  /* values of every curve at a place along x */
  function readCurves(state, pixel) {
    const x = state.x.back(pixel), lines = [state.spec.x.title + ": " + value(x)];
    for (const { own } of state.panels) {
      for (const trace of own) {
        if (trace.x.length && x >= trace.x[0] && x <= trace.x[trace.x.length - 1]) {
          lines.push(`${trace.name}: ${value(trace.y[nearest(trace.x, x)])} ${trace.unit}`);
        }
      }
    }
    return lines;
  }
  function pointAt(state, px, py) {
    let best = null, reach = 14;
    for (const { own, y } of state.panels) {
      for (const trace of own.filter((item) => item.symbol)) {
        trace.x.forEach((x, i) => {
          const away = Math.hypot(state.x(x) - px, y(trace.y[i]) - py);
          if (away < reach) { reach = away; best = { trace, i }; }
        });
      }
    }
    return best;
  }
  function tell(state, px, lines) {
    state.tip.replaceChildren(...lines.map((line) => TV.element("div", {}, line)));
    state.tip.hidden = false;
    state.tip.style.left = (px > state.width / 2 ? px - state.tip.offsetWidth - 12 : px + 12) + "px";
    state.tip.style.top = state.whole.top + "px";
  }
  function cursor(state, px) {
    state.drawing.querySelectorAll(".cursor").forEach((node) => node.remove());
    state.at = px;
    if (px === null) { state.tip.hidden = true; return; }
    const { left, width, top, bottom } = state.whole, held = Math.max(left, Math.min(left + width, px));
    state.drawing.append(TV.chart.svg("path", { class: "cursor", d: `M${held} ${top}V${bottom}`, stroke: "var(--muted)", "stroke-dasharray": "3 3" }));
    tell(state, held, readCurves(state, held));
  }
  function hover(state, px, py) {
    if (px < state.whole.left || py < state.whole.top || py > state.whole.bottom) { cursor(state, null); return; }
    if (!state.spec.points) { cursor(state, px); return; }
    const found = pointAt(state, px, py);
    state.host.classList.toggle("on-point", Boolean(found));
    if (!found) { state.tip.hidden = true; return; }
    const { trace, i } = found;
    tell(state, px, [trace.labels[i], `reference ${value(trace.x[i])}, predicted ${value(trace.y[i])} ${trace.unit}`, trace.name]);
  }
  function toggle(state, name) {
    if (!state.hidden.delete(name)) { state.hidden.add(name); }
    show(state);
  }

  function listen(state) {
    const { host } = state;
    const place = (event) => { const box = host.getBoundingClientRect(); return [event.clientX - box.x, event.clientY - box.y]; };
    let from = null;
    host.tabIndex = 0;
    host.addEventListener("pointermove", (event) => hover(state, ...place(event)));
    host.addEventListener("pointerleave", () => cursor(state, null));
    host.addEventListener("pointerdown", (event) => { from = event.pointerType === "mouse" ? place(event) : null; });
    host.addEventListener("pointerup", (event) => {
      if (!from) { return; }
      const ends = [from[0], place(event)[0]].sort((a, b) => a - b);
      from = null;
      if (ends[1] - ends[0] > 8) { state.view = ends.map(state.x.back); show(state); }
    });
    host.addEventListener("dblclick", () => { if (state.view) { state.view = null; show(state); } });
    host.addEventListener("click", (event) => {
      const key = event.target.closest(".key"), found = state.pick && pointAt(state, ...place(event));
      if (key) { toggle(state, key.dataset.name); } else if (found && found.trace.ids) { state.pick(found.trace.ids[found.i]); }
    });
    host.addEventListener("keydown", (event) => {
      const key = event.target.closest(".key"), step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (key && (event.key === "Enter" || event.key === " ")) { event.preventDefault(); toggle(state, key.dataset.name); }
      if (step && !key && !state.spec.points) {
        event.preventDefault();
        cursor(state, Math.max(state.whole.left, Math.min(state.whole.left + state.whole.width, (state.at === null ? state.whole.left : state.at) + step * state.whole.width / 60)));
      }
    });
    new ResizeObserver(() => { if (Math.abs(host.clientWidth - state.width) > 1) { show(state); } }).observe(host);
  }
  return draw;
})();
