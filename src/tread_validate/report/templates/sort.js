/* Sortable tables: a button in each header; numbers by their value, text by the locale; groups stay together. */
"use strict";
TV.sortTables = function (root) {
  for (const table of root.querySelectorAll("table.sortable")) {
    const headers = Array.from(table.querySelectorAll("thead th"));
    headers.forEach((header, index) => {
      const button = header.querySelector("button.sort");
      if (!button) { return; }
      button.addEventListener("click", () => {
        const ascending = header.getAttribute("aria-sort") !== "ascending";
        headers.forEach((other) => other.removeAttribute("aria-sort"));
        header.setAttribute("aria-sort", ascending ? "ascending" : "descending");
        for (const body of table.tBodies) { TV.sortBody(body, index, ascending); }
      });
    });
  }
};
TV.sortBody = function (body, index, ascending) {
  const rows = Array.from(body.rows).filter((row) => !row.classList.contains("group"));
  const value = (row) => {
    const cell = row.cells[index];
    const key = cell.dataset.sort;
    if (key === undefined) { return cell.textContent.trim(); }
    return key === "" ? null : Number(key);
  };
  const kind = (row) => row.cells[index].dataset.kind || "";
  const compare = (a, b) => {
    const x = value(a), y = value(b);
    if (x === null || y === null) { return (x === null) - (y === null); } /* what has no value goes last both ways */
    if (kind(a) !== kind(b)) { return kind(a).localeCompare(kind(b)); } /* per cent, newtons and scores stay apart */
    const order = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y), "en", { numeric: true });
    return ascending ? order : -order;
  };
  rows.sort(compare).forEach((row) => body.appendChild(row));
};
