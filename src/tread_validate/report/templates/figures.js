/* Drawn figures: inflated when they come near the window, let go when they are far away. Every figure and chart is saved
   as SVG, PNG or CSV out of the page itself, so that a page that was mailed alone can do it too. */
"use strict";
TV.figures = (function () {
  const images = Array.from(document.querySelectorAll("img[data-figure]"));
  async function drawing(key) {
    if (TV.data.figures[key]) { return TV.inflate(TV.data.figures[key]); }
    const packed = document.querySelector("#figure-" + CSS.escape(key) + " img").src.split(",")[1];
    return new TextDecoder().decode(TV.bytes(packed));
  }
  async function show(image) {
    if (image.src) { return; }
    const text = TV.joined(await drawing(image.dataset.figure));
    if (!image.src) { image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })); }
    return image.decode();
  }
  function hide(image) {
    if (!image.src) { return; }
    URL.revokeObjectURL(image.src);
    image.removeAttribute("src");
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
  /* the numbers of a chart as they are drawn; those of the case browser name their case */
  function traces(chart) {
    const field = (value) => (typeof value === "number" ? String(Number(value.toPrecision(6))) : '"' + String(value).replaceAll('"', '""') + '"');
    const lines = ["panel,series,point,x,y"];
    for (const trace of chart.data) {
      const across = chart.layout.xaxis.title.text, up = chart.layout["yaxis" + (trace.yaxis || "y").slice(1)].title.text;
      trace.x.forEach((x, i) => lines.push([up + " against " + across, trace.name, trace.customdata ? trace.customdata[i] : "", x, trace.y[i]].map(field).join(",")));
    }
    return lines.join("\n") + "\n";
  }
  /* what a button saves: a blob and its name */
  async function made(key, kind) {
    const chart = document.getElementById(key);
    const name = (chart ? (key === "case-plot" ? TV.browser.current() : key) : key) + "." + kind;
    if (kind === "csv") {
      const text = chart ? traces(chart) : await TV.inflate(TV.data.numbers[key]);
      return [new Blob([text], { type: "text/csv" }), name];
    }
    if (!chart) { return [kind === "png" ? await png(key) : new Blob([await drawing(key)], { type: "image/svg+xml" }), name]; }
    const address = await Plotly.toImage(chart, { format: kind, scale: kind === "png" ? 3 : 1, width: chart.clientWidth, height: chart.clientHeight });
    const body = address.slice(address.indexOf(",") + 1);
    const bytes = kind === "svg" ? decodeURIComponent(body) : TV.bytes(body);
    return [new Blob([bytes], { type: kind === "svg" ? "image/svg+xml" : "image/png" }), name];
  }
  async function save(key, kind) {
    const [blob, name] = await made(key, kind);
    const link = TV.element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  function start() {
    const watch = new IntersectionObserver((entries) => {
      for (const entry of entries) { if (entry.isIntersecting) { show(entry.target); } else { hide(entry.target); } }
    }, { rootMargin: "400px 0px" });
    images.forEach((image) => watch.observe(image));
    document.addEventListener("click", (event) => {
      const button = event.target.closest("button.save");
      if (button) { save(button.dataset.of, button.dataset.save); }
    });
  }
  return { start, made, all: () => Promise.all(images.map(show)) };
})();
