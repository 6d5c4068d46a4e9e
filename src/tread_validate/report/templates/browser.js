/* Case browser: factors choose a case; its histories are drawn over each other, its errors stand beside them. */
"use strict";
TV.browser = (function () {
  const data = TV.data;
  const byId = new Map(data.cases.map((item) => [item.id, item]));
  let current = null, held = null, visible = false;

  /* histories and errors of one case, inflated when it is shown */
  async function fetchCase(id) {
    return JSON.parse(await TV.inflate(data.packed[id]));
  }

  /* packed histories: differences, in whole multiples of a scale */
  function unpack(packed) {
    const sums = (steps, scale) => { let sum = 0; return steps && steps.map((step) => (sum += step) * scale); };
    return {
      time: sums(packed.t, packed.ts), normal: sums(packed.n, packed.ns),
      tangential: sums(packed.q, packed.qs), slipping: sums(packed.s, 0.001),
    };
  }

  function nearest(factor, level) {
    const score = (item) => data.factors.reduce((sum, other) => sum + (item.levels[other.key] === current.levels[other.key] ? 1 : 0), 0);
    const candidates = data.cases.filter((item) => item.levels[factor] === level);
    return candidates.reduce((best, item) => (best === null || score(item) > score(best) ? item : best), null);
  }

  function drawFactors() {
    const group = data.cases.filter((item) => item.run === current.run && item.levels.path === current.levels.path);
    for (const factor of data.factors) {
      const field = document.getElementById("factor-" + factor.key);
      const here = new Set((factor.key === "path" ? data.cases : group).map((item) => item.levels[factor.key]));
      field.hidden = here.size < 2 && factor.key !== "path";
      for (const input of field.querySelectorAll("input")) {
        const index = Number(input.value);
        input.parentElement.hidden = !here.has(index);
        input.checked = current.levels[factor.key] === index;
      }
    }
  }

  function drawHistories(own) {
    const traces = [];
    for (const source of data.sources) {
      const packed = own.histories[source.key];
      if (!packed) { continue; }
      const history = unpack(packed);
      const line = { color: TV.ink(source.color), dash: source.dash, width: source.reference ? 2.4 : 1.8 };
      const common = { mode: "lines", type: "scatter", x: history.time, line, name: source.label, legendgroup: source.key };
      traces.push(Object.assign({}, common, { y: history.normal, hovertemplate: "%{y:.1f} N" }));
      if (history.tangential) { traces.push(Object.assign({}, common, { y: history.tangential, yaxis: "y2", showlegend: false, hovertemplate: "%{y:.2f} N" })); }
      if (source.slips && history.slipping) { traces.push(Object.assign({}, common, { y: history.slipping.map((v) => 100 * v), yaxis: "y3", showlegend: false, hovertemplate: "%{y:.0f} %" })); }
    }
    const layout = TV.layout({
      grid: { rows: 3, columns: 1 }, hovermode: "x unified", dragmode: TV.coarse ? false : "zoom",
      xaxis: TV.axis("time from first contact, ms", { anchor: "y3", domain: [0, 1] }),
      yaxis: TV.axis("normal force, N", { domain: [0.62, 1] }),
      yaxis2: TV.axis("longitudinal force, N", { domain: [0.25, 0.57] }),
      yaxis3: TV.axis("sliding area, %", { domain: [0, 0.2], range: [-4, 104], dtick: 50 }),
      height: 560,
    });
    if (traces.length === 0) {
      layout.annotations = [{ text: "no history for this case", showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0.8 }];
    }
    return TV.draw("case-plot", traces, layout);
  }

  function drawErrors(own) {
    const body = document.getElementById("case-errors");
    body.replaceChildren();
    let last = null;
    for (const row of own.errors) {
      const pair = row.p + " compared with " + row.r;
      if (pair !== last) {
        const head = TV.element("th", { colspan: 5, scope: "colgroup" }, pair);
        if (row.why) { head.append(TV.element("span", { class: "why" }, row.why)); }
        body.append(TV.element("tr", { class: "group" }, head));
        last = pair;
      }
      const assessment = TV.element("td", { class: "assessment " + (row.tone ? row.tone + "-text" : "") }, row.v);
      if (row.u) { assessment.append(TV.element("span", { class: "why" }, row.u)); }
      if (row.note) { assessment.append(TV.element("span", { class: "why" }, row.note)); }
      body.append(TV.element("tr", {}, TV.element("td", {}, row.q), TV.element("td", { class: "num" }, row.a),
        TV.element("td", { class: "num" }, row.b), TV.element("td", { class: "num" }, row.e), assessment));
    }
    if (!body.children.length) {
      body.append(TV.element("tr", {}, TV.element("td", { colspan: 5 }, "No comparison for this case.")));
    }
  }

  function drawHead() {
    document.getElementById("case-title").textContent = current.label;
    document.getElementById("case-id").textContent = current.id;
    document.getElementById("case-status").textContent = current.status;
    const marks = document.getElementById("case-marks");
    marks.replaceChildren();
    for (const [origin, members] of current.marks) {
      const tag = TV.element("span", { class: "mark" }, origin);
      for (const mark of members) { tag.append(" ", TV.element("a", { href: "#" + mark.href, title: mark.title }, mark.text)); }
      marks.append(tag, " ");
    }
    document.getElementById("case-link").setAttribute("href", "#case=" + current.id);
  }

  async function show(id, moveHash) {
    const item = byId.get(id);
    if (!item) { return false; }
    current = item;
    const unknown = document.getElementById("case-unknown");
    unknown.hidden = true;
    drawHead(); drawFactors();
    if (moveHash) { history.replaceState(null, "", "#case=" + id); }
    const own = await fetchCase(id);
    if (current !== item) { return true; }
    held = own;
    drawErrors(own);
    if (visible) { await drawHistories(own); }
    return true;
  }

  /* An address that names no case of this report says so, and shows the first case. */
  function fromHash(scroll) {
    const match = /^#case=(.*)$/.exec(location.hash);
    if (!match) { return false; }
    let id = match[1];
    try { id = decodeURIComponent(id); } catch { /* taken as it stands */ }
    const known = byId.has(id);
    const shown = show(known ? id : (current ? current.id : data.first), false);
    if (!known) {
      shown.then(() => {
        const unknown = document.getElementById("case-unknown");
        unknown.textContent = "This report has no case " + id + "; shown is " + current.id + ".";
        unknown.hidden = false;
      });
    }
    if (scroll) { document.getElementById("browser").scrollIntoView({ block: "start" }); }
    return true;
  }

  function step(by) {
    const index = data.cases.indexOf(current);
    show(data.cases[(index + by + data.cases.length) % data.cases.length].id, true);
  }

  function start() {
    if (!data.cases.length) { return; }
    document.getElementById("factors").addEventListener("change", (event) => {
      const factor = event.target.name.replace(/^factor-/, "");
      const item = nearest(factor, Number(event.target.value));
      if (item) { show(item.id, true); }
    });
    document.getElementById("case-previous").addEventListener("click", () => step(-1));
    document.getElementById("case-next").addEventListener("click", () => step(1));
    window.addEventListener("hashchange", () => fromHash(true));
    const redraw = () => { if (held && visible) { drawHistories(held); } };
    TV.near(document.getElementById("case-plot"), () => { visible = true; redraw(); });
    TV.dark.addEventListener("change", redraw);
    if (!fromHash(true)) { show(data.first, false); }
  }
  return { start, show, current: () => (current ? current.id : null) };
})();
