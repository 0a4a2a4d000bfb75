// Where on a heat map a point lies: put in front of the scripts that go there, read it or draw the
// lines across it. See app/bearing_explorer/kit/plots/heat_map.py.
//
// `image`: source of the pictures, the first `count` of which are maps. `stands`: source whose first
// row says what the sides stand for where that is not what they are drawn over; or null.
const place_on = (image, stands, count, x, y) => {
  const {data} = image
  const said = stands ? stands.data : data
  // a map that says what its sides are has none before its first numbers
  if (said.across && !said.across.length) return null
  const first = (name, usual) => said[name]?.[0] ?? usual
  for (let map = 0; map < count; map++) {
    const grid = data.image[map]
    if (!grid?.shape || grid.shape.length != 2) continue
    const [rows, columns] = grid.shape
    const [left, bottom, width, height] = [data.x[map], data.y[map], data.dw[map], data.dh[map]]
    const [across, up] = [(x - left)/width, (y - bottom)/height]
    if (!(0 <= across && across <= 1 && 0 <= up && up <= 1)) continue
    const cell = (share, n) => Math.min(n - 1, Math.floor(share*n))
    const [column, row] = [cell(across, columns), cell(up, rows)]
    const side = (which, begin, end, share, middle) => ({
      which,
      value: begin + share*(end - begin),
      middle: begin + middle*(end - begin),
    })
    return {
      map, rows, columns, row, column,
      x: side(first("across", 0), first("x_first", left), first("x_last", left + width),
        across, (column + 0.5)/columns),
      y: side(first("up", 1), first("y_first", bottom), first("y_last", bottom + height),
        up, (row + 0.5)/rows),
      turn: first("turn", 1), start: first("start", 0),
    }
  }
  return null
}
