// Sorts a verdict table by the column whose head is clicked, or chosen with Enter: first upwards, then downwards.
document.documentElement.classList.add("js");
for (const table of document.querySelectorAll("table.verdict")) {
  const width = table.tBodies[0].rows[0].cells.length;
  const grid = [[], []];  // the column that each head stands above: heads of two rows do not
  [...table.tHead.rows].forEach((row, r) => {
    let k = 0;
    for (const head of row.cells) {
      while (grid[r][k]) ++k;
      for (let i = 0; i < head.colSpan; ++i)
        for (let j = 0; j < head.rowSpan; ++j) grid[r + j][k + i] = head;
      if (head.colSpan === 1) make(head, k);
    }
  });
  function make(head, column) {
    if (column >= width) return;
    head.tabIndex = 0;
    const sort = () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      for (const other of table.querySelectorAll("th[aria-sort]")) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const value = row => {
        const cell = row.cells[column];
        return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
      };
      const rows = [...table.tBodies[0].rows].sort((a, b) => {
        const x = value(a), y = value(b);
        const order = typeof x === "string" ? x.localeCompare(y) : x - y;
        return down ? -order : order;
      });
      table.tBodies[0].append(...rows);
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", event => { if (event.key === "Enter") sort(); });
  }
}
// Animations stand still for readers who asked for less motion; a click, Enter or a blank stops one or lets it go on.
for (const svg of document.querySelectorAll("svg.moving")) {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) svg.pauseAnimations();
  const change = () => svg.animationsPaused() ? svg.unpauseAnimations() : svg.pauseAnimations();
  svg.addEventListener("click", change);
  svg.addEventListener("keydown", event => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    change();
  });
}
