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
      const common = { x: history.time, name: source.label, color: source.color, dash: source.dash, width: source.reference ? 2.4 : 1.8 };
      traces.push(Object.assign({}, common, { y: history.normal, panel: 0, unit: "N" }));
      if (history.tangential) { traces.push(Object.assign({}, common, { y: history.tangential, panel: 1, unit: "N" })); }
      if (source.slips && history.slipping) { traces.push(Object.assign({}, common, { y: history.slipping.map((v) => 100 * v), panel: 2, unit: "%" })); }
    }
    TV.draw("case-plot", {
      height: 560, x: { title: "time from first contact, ms" }, traces, empty: traces.length ? "" : "no history for this case",
      panels: [{ title: "normal force, N", share: 0.43 }, { title: "longitudinal force, N", share: 0.35 }, { title: "sliding area, %", share: 0.22, range: [-4, 104], ticks: [0, 50, 100] }],
    });
  }

  /* The rows of the error table as [class, cells], a cell as [text, class, what stands small below it]. */
  function errorRows(errors) {
    const rows = [];
    let last = null;
    for (const row of errors) {
      const pair = row.p + " compared with " + row.r;
      if (pair !== last) {
        rows.push(["group", [[pair, "", [row.why]]]]);
        last = pair;
      }
      rows.push(["", [[row.q, "", []], [row.a, "num", []], [row.b, "num", []], [row.e, "num", []],
        [row.v, "assessment " + (row.tone ? row.tone + "-text" : ""), [row.u, row.note]]]]);
    }
    return rows.length ? rows : [["", [["No comparison for this case.", "", []]]]];
  }

  /* Rows are kept from case to case and only their words changed: rows made anew at every step would wait for the
     browser's garbage collector with all their boxes, 2 MB a case. */
  function drawErrors(own) {
    const body = document.getElementById("case-errors"), every = document.getElementById("case-all");
    const first = own.errors.filter((row) => row.first), all = every.getAttribute("aria-pressed") === "true" || !first.length;
    const rows = errorRows(all ? own.errors : first);
    every.textContent = `All ${own.errors.length} errors`;
    while (body.rows.length > rows.length) { body.lastElementChild.remove(); }
    rows.forEach(([name, cells], i) => {
      let line = body.rows[i];
      if (!line || line.className !== name || line.cells.length !== cells.length) {
        const tag = name ? "th" : "td", span = cells.length === 1 ? 5 : null;
        const fresh = TV.element("tr", { class: name || null }, ...cells.map(() => TV.element(tag, { colspan: span, scope: name ? "colgroup" : null }, "")));
        if (line) { line.replaceWith(fresh); } else { body.append(fresh); }
        line = fresh;
      }
      cells.forEach(([text, kind, notes], j) => fill(line.cells[j], text, kind, notes.filter(Boolean)));
    });
  }

  function fill(cell, text, kind, notes) {
    if (cell.className !== kind) { cell.className = kind; }
    if (!cell.firstChild || cell.firstChild.nodeType !== Node.TEXT_NODE) { cell.prepend(document.createTextNode("")); }
    if (cell.firstChild.data !== text) { cell.firstChild.data = text; }
    while (cell.children.length > notes.length) { cell.lastElementChild.remove(); }
    notes.forEach((note, k) => {
      const span = cell.children[k] || cell.appendChild(TV.element("span", { class: "why" }, ""));
      if (span.textContent !== note) { span.textContent = note; }
    });
  }

  function drawHead() {
    document.getElementById("case-title").textContent = current.label;
    document.getElementById("case-id").textContent = current.id;
    document.getElementById("case-status").textContent = current.status;
    const marks = document.getElementById("case-marks");
    marks.replaceChildren();
    for (const [origin, members] of current.marks) {
      const tag = TV.element("span", { class: "mark" }, origin);
      for (const code of members) { tag.append(" ", TV.element("a", { href: "#assumption-" + code, title: data.marks[code] }, code)); }
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
    if (visible) { drawHistories(own); }
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
    document.getElementById("case-all").addEventListener("click", (event) => {
      event.target.setAttribute("aria-pressed", String(event.target.getAttribute("aria-pressed") !== "true"));
      if (held) { drawErrors(held); }
    });
    document.getElementById("case-previous").addEventListener("click", () => step(-1));
    document.getElementById("case-next").addEventListener("click", () => step(1));
    window.addEventListener("hashchange", () => fromHash(true));
    const redraw = () => { if (held && visible) { drawHistories(held); } };
    TV.near(document.getElementById("case-plot"), () => { visible = true; redraw(); });
    if (!fromHash(true)) { show(data.first, false); }
  }
  return { start, show, current: () => (current ? current.id : null) };
})();
