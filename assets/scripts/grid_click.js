// A click goes to the middle of the cell clicked at, the way of typed numbers. See controls.js.
const p = cells.data.packed
if (p.length > head) {
  const [columns, rows, left, width, bottom, height, , across, up] = p
  const column = Math.floor((cb_obj.x - left)/width*columns)
  const row = Math.floor((cb_obj.y - bottom)/height*rows)
  if (0 <= column && column < columns && 0 <= row && row < rows) {
    const middle = (start, length, count, index) =>
      Number((start + length*(index + 0.5)/count).toPrecision(6))
    const typed = {}
    const {name: x} = quantities[across], {name: y} = quantities[up]
    if (x) typed[x] = middle(left, width, columns, column)
    if (y) typed[y] = middle(bottom, height, rows, row)
    window.dispatchEvent(new CustomEvent("explorer-typed", {detail: typed}))
  }
}
