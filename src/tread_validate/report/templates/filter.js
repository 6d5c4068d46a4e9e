/* Table filters, and scroll regions that a keyboard can reach only where there is something to scroll. */
"use strict";
TV.filterTables = function (root) {
  for (const input of root.querySelectorAll("input.filter")) {
    input.addEventListener("input", () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const body of document.getElementById(input.dataset.table).tBodies) {
        let shown = 0;
        const group = body.rows[0].classList.contains("group") ? body.rows[0] : null;
        const prefix = group ? group.textContent.toLowerCase() + " " : "";
        for (const row of body.rows) {
          if (row === group) { continue; }
          const text = prefix + row.textContent.toLowerCase();
          row.hidden = !words.every((word) => text.includes(word));
          shown += row.hidden ? 0 : 1;
        }
        if (group) { group.hidden = shown === 0; }
      }
    });
  }
};
TV.scrollRegions = function (root) {
  const mark = (region) => {
    if (region.scrollWidth > region.clientWidth + 1 || region.scrollHeight > region.clientHeight + 1) { region.tabIndex = 0; } else { region.removeAttribute("tabindex"); }
  };
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => mark(entry.target)));
  root.querySelectorAll(".scroll").forEach((region) => watch.observe(region));
};
