// What stands under the pointer on a map, a line each of `$x`, `$y` and the value.
const data = image.data
const grid = data.image[0]
if (!grid || !grid.shape || grid.shape.length != 2) return ""
const [rows, columns] = grid.shape
const inside = (share, count) => Math.min(count - 1, Math.max(0, Math.floor(share*count)))
const column = inside((special_vars.x - data.x[0])/data.dw[0], columns)
const row = inside((special_vars.y - data.y[0])/data.dh[0], rows)
const number = (v, digits) => String(Number(v.toPrecision(digits))).replace("-", "\u2212")
if (wanted == "x")
  return `${words}: ${number(data.x[0] + (column + 0.5)*data.dw[0]/columns, 4)}${unit}`
if (wanted == "y")
  return `${words}: ${number(data.y[0] + (row + 0.5)*data.dh[0]/rows, 4)}${unit}`
const found = grid[row*columns + column]
if (isNaN(found)) return "no answer"
return `${words}: ` + (prefixed ? si(found, unit.trim(), 4) : number(found, 4) + unit)
