// What the number of a cell of the sixteen maps means. See app/bearing_explorer/views/maps.py.
const floats = points.data.bits
const p = new Uint16Array(floats.buffer, floats.byteOffset, 2*floats.length)
const {map: i, rows, columns, row, column} = at
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
