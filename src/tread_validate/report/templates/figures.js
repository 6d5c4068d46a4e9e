/* Drawn figures: inflated into the page when they come near the window, let go when they are far away. Every figure and
   chart is saved as SVG, PNG or CSV out of the page itself, so that a page that was mailed alone can do it too. */
"use strict";
TV.figures = (function () {
  const places = Array.from(document.querySelectorAll(".drawing"));
  const first = new Map();
  async function drawing(key) {
    const chart = document.getElementById(key);
    if (chart) { return TV.chart.text(chart); }
    if (TV.data.figures[key]) { return TV.inflate(TV.data.figures[key]); }
    return first.get(key);
  }
  async function show(place) {
    if (place.firstElementChild) { return; }
    const text = TV.themed(await drawing(place.dataset.figure), place.dataset.figure);
    if (!place.firstElementChild) { place.innerHTML = text; }
  }
  /* the first screen's picture stands in the page as an image, for readers without scripts */
  function adopt(place) {
    const image = place.querySelector("img");
    if (!image) { return; }
    first.set(place.dataset.figure, new TextDecoder().decode(TV.bytes(image.src.split(",")[1])));
    Object.entries({ role: "img", "aria-label": image.alt }).forEach(([key, value]) => place.setAttribute(key, value));
    image.remove();
    show(place);
  }
  async function png(key) {
    const image = new Image();
    image.src = URL.createObjectURL(new Blob([await drawing(key)], { type: "image/svg+xml" }));
    await image.decode();
    const canvas = TV.element("canvas", { width: 3 * image.naturalWidth, height: 3 * image.naturalHeight });
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(image, 0, 0, canvas.width, canvas.height);
    URL.revokeObjectURL(image.src);
    return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  }
  /* the numbers of a chart as they are drawn; points name their case */
  function traces(chart) {
    const field = (value) => (typeof value === "number" ? String(Number(value.toPrecision(6))) : '"' + String(value).replaceAll('"', '""') + '"');
    const lines = ["panel,series,point,x,y"];
    for (const trace of chart.data) {
      const panel = chart.spec.panels[trace.panel || 0].title + " against " + chart.spec.x.title;
      trace.x.forEach((x, i) => lines.push([panel, trace.name, trace.ids ? trace.ids[i] : "", x, trace.y[i]].map(field).join(",")));
    }
    return lines.join("\n") + "\n";
  }
  /* what a button saves: a blob and its name */
  async function made(key, kind) {
    const chart = document.getElementById(key), name = (key === "case-plot" ? TV.browser.current() : key) + "." + kind;
    if (kind === "png") { return [await png(key), name]; }
    if (kind === "svg") { return [new Blob([await drawing(key)], { type: "image/svg+xml" }), name]; }
    return [new Blob([chart ? traces(chart) : await TV.inflate(TV.data.numbers[key])], { type: "text/csv" }), name];
  }
  async function save(key, kind) {
    const [blob, name] = await made(key, kind);
    const link = TV.element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  function start() {
    const watch = new IntersectionObserver((entries) => {
      for (const entry of entries) { if (entry.isIntersecting) { show(entry.target); } else { entry.target.replaceChildren(); } }
    }, { rootMargin: "400px 0px" });
    places.forEach(adopt);
    places.forEach((place) => watch.observe(place));
    document.addEventListener("click", (event) => {
      const button = event.target.closest("button.save");
      if (button) { save(button.dataset.of, button.dataset.save); }
    });
  }
  return { start, made, all: () => Promise.all(places.map(show)) };
})();
