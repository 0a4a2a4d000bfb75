// What stands under the pointer, a line each of `$x`, `$y` and the value. See app/bearing_explorer/figures/heat_map.py.
const p = cells.data.packed
if (!(p.length > head)) return ""
const [columns, rows, left, width, bottom, height, , across, up] = p
const number = (x, digits) => String(Number(x.toPrecision(digits))).replace("-", "\u2212")
const column = Math.min(columns - 1, Math.max(0, Math.floor((special_vars.x - left)/width*columns)))
const row = Math.min(rows - 1, Math.max(0, Math.floor((special_vars.y - bottom)/height*rows)))
const at = (which, start, length, count, index) => {
  const {words, unit} = quantities[which]
  return `${words}: ${number(start + length*(index + 0.5)/count, 4)}${unit}`
}
if (wanted == "x") return at(across, left, width, columns, column)
if (wanted == "y") return at(up, bottom, height, rows, row)
const cell = Array.from({length: n_layers}, (_, k) => p[head + (k*rows + row)*columns + column])
return say(cell)
