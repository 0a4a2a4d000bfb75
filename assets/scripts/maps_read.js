// What stands under the pointer. See app/bearing_explorer/views/maps.py.
const i = special_vars.index
const frame = frames.data, box = {}
for (const side of ["left", "right", "bottom", "top"]) box[side] = frame[side][i]
const across = (special_vars.x - box.left)/(box.right - box.left)
const up = (special_vars.y - box.bottom)/(box.top - box.bottom)
const ends = (name) => [grid.data["first_" + name][0], grid.data["last_" + name][0]]
const at = (name, share) => {
  const [first, last] = ends(name)
  return Math.max(0, first + share*(last - first)).toFixed(1) + "°"
}
if (wanted == "extent") return at("extent", up)
if (wanted == "angle")
  return (grid.data.of_shaft[0] ? "Shaft angle " : "Cage angle ") + at("angle", across)
const floats = points.data.bits
const p = new Uint16Array(floats.buffer, floats.byteOffset, 2*floats.length)
const rows = p[0], columns = p[1]
const row = Math.min(rows - 1, Math.max(0, Math.floor(up*rows)))
const column = Math.min(columns - 1, Math.max(0, Math.floor(across*columns)))
const whole = p[head + (i*rows + row)*columns + column]
if (whole === none || whole === undefined) return "no answer"
const low = cells.data.low[i], high = cells.data.high[i], unit = units[cells.data.unit[i]]
const found = low + whole/greatest*(high - low)
if (!unit) return String(Math.round(found))
if (cells.data.kind[i] == 3) return "0"
const names = {"-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
const top = Math.max(Math.abs(low), Math.abs(high))
const e = Math.max(-12, Math.min(12, 3*Math.floor(Math.log10(top*1.0000001)/3)))
return String(Number((found/10**e).toPrecision(4))).replace("-", "\u2212") + " " + names[e] + unit
