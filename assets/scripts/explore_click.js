// A click on a map goes to the middle of the cell clicked at, the way of typed numbers.
const data = image.data
const grid = data.image[0]
if (grid && grid.shape && grid.shape.length == 2) {
  const [rows, columns] = grid.shape
  const column = Math.floor((cb_obj.x - data.x[0])/data.dw[0]*columns)
  const row = Math.floor((cb_obj.y - data.y[0])/data.dh[0]*rows)
  if (0 <= column && column < columns && 0 <= row && row < rows) {
    const at = (start, length, count, index) =>
      Number((start + length*(index + 0.5)/count).toPrecision(6))
    const typed = {
      [names[0]]: at(data.x[0], data.dw[0], columns, column),
      [names[1]]: at(data.y[0], data.dh[0], rows, row),
    }
    window.dispatchEvent(new CustomEvent("explorer-typed", {detail: typed}))
  }
}
