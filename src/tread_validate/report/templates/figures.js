/* Drawn figures: inflated when they come near the window, let go when they are far away; saved as PNG. */
"use strict";
TV.figures = (function () {
  const images = Array.from(document.querySelectorAll("img[data-figure]"));
  async function show(image) {
    if (image.src) { return; }
    const text = await TV.inflate(TV.data.figures[image.dataset.figure]);
    if (!image.src) { image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })); }
    return image.decode();
  }
  function hide(image) {
    if (!image.src) { return; }
    URL.revokeObjectURL(image.src);
    image.removeAttribute("src");
  }
  async function png(key) {
    const image = document.querySelector("#figure-" + CSS.escape(key) + " img");
    if (image.dataset.figure) { await show(image); }
    const canvas = TV.element("canvas", { width: 3 * image.naturalWidth, height: 3 * image.naturalHeight });
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(image, 0, 0, canvas.width, canvas.height);
    return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  }
  function save(blob, name) {
    const link = TV.element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  function start() {
    const watch = new IntersectionObserver((entries) => {
      for (const entry of entries) { if (entry.isIntersecting) { show(entry.target); } else { hide(entry.target); } }
    }, { rootMargin: "900px 0px" });
    images.forEach((image) => watch.observe(image));
    for (const button of document.querySelectorAll("button.png")) {
      button.addEventListener("click", async () => save(await png(button.dataset.png), button.dataset.png + ".png"));
    }
  }
  return { start, png, save, all: () => Promise.all(images.map(show)) };
})();
