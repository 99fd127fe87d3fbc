// Sorting and filtering of the lists. Without it they are whole and in the order of their ranks.
(function () {
  "use strict";

  function key(row, column) {
    const cell = row.cells[column];
    return cell.dataset.sort === undefined ? cell.textContent.trim() : Number(cell.dataset.sort);
  }

  function compare(a, b) {
    if (typeof a === "number" && typeof b === "number") return a - b;
    return String(a).localeCompare(String(b), "en", { numeric: true });
  }

  function sort(table, header, rising) {
    const column = header.cellIndex;
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", rising ? "ascending" : "descending");
    const body = table.tBodies[0];
    const rows = Array.from(body.rows);
    rows.sort(function (a, b) {
      const order = compare(key(a, column), key(b, column));
      return rising ? order : -order;
    });
    body.append(...rows);
  }

  function makeSortable(table) {
    for (const header of table.tHead.rows[0].cells) {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...header.childNodes);
      button.addEventListener("click", function () {
        sort(table, header, header.getAttribute("aria-sort") !== "ascending");
      });
      header.append(button);
    }
    table.before(sorter(table));
  }

  // Where rows are cards, the headers cannot be clicked.
  function sorter(table) {
    const headers = Array.from(table.tHead.rows[0].cells);
    const select = choice("Order of the list", []);
    headers.forEach(function (header, column) {
      const name = header.textContent.replace(/\u00ad/g, "");
      select.add(new Option(name + ", rising", column + " rising"));
      select.add(new Option(name + ", falling", column + " falling"));
    });
    select.addEventListener("input", function () {
      const words = select.value.split(" ");
      if (words.length === 2) sort(table, headers[Number(words[0])], words[1] === "rising");
    });
    const bar = document.createElement("div");
    bar.className = "sorter";
    bar.append(select);
    return bar;
  }

  function choice(words, values) {
    const select = document.createElement("select");
    select.setAttribute("aria-label", words);
    select.add(new Option(words, ""));
    for (const value of values) select.add(new Option(value, value));
    return select;
  }

  function valuesOf(rows, name) {
    const values = new Set(rows.map(function (row) { return row.dataset[name] || ""; }));
    values.delete("");
    return Array.from(values).sort();
  }

  function makeFilterable(table) {
    const rows = Array.from(table.tBodies[0].rows);
    const bar = document.createElement("div");
    bar.className = "filters";
    const search = document.createElement("input");
    search.type = "search";
    search.placeholder = "Filter by any word";
    search.setAttribute("aria-label", "Filter by any word");
    const verdict = choice("All verdicts", valuesOf(rows, "verdict"));
    const status = choice("All states", valuesOf(rows, "status"));
    const shown = document.createElement("output");
    bar.append(search, verdict, status, shown);
    table.before(bar);

    function apply() {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      let count = 0;
      for (const row of rows) {
        const text = row.textContent.toLowerCase();
        const fits = words.every(function (word) { return text.includes(word); }) &&
          (verdict.value === "" || row.dataset.verdict === verdict.value) &&
          (status.value === "" || row.dataset.status === status.value);
        row.hidden = !fits;
        if (fits) count += 1;
      }
      shown.value = count + " of " + rows.length + (rows.length === 1 ? " loop" : " loops");
    }
    for (const control of [search, verdict, status]) control.addEventListener("input", apply);
    apply();
  }

  for (const table of document.querySelectorAll("table.sortable")) makeSortable(table);
  for (const table of document.querySelectorAll("table.filterable")) makeFilterable(table);
})();
