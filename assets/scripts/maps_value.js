// What the number of a cell of the sixteen maps means; the prefixes of the house style are put in front. See app/bearing_explorer/explorer/views/maps.py.
const floats = points.data.bits
const p = new Uint16Array(floats.buffer, floats.byteOffset, 2*floats.length)
const {map: i, rows, columns, row, column} = at
const whole = p[head + (i*rows + row)*columns + column]
if (whole === none || whole === undefined) return "no answer"
const low = cells.data.low[i], high = cells.data.high[i], unit = units[cells.data.unit[i]]
const found = low + whole/greatest*(high - low)
if (!unit) return String(Math.round(found))
if (cells.data.kind[i] == 3) return "0"
const e = power(Math.max(Math.abs(low), Math.abs(high)))
return minus(String(Number((found/10**e).toPrecision(4)))) + " " + names[e] + unit
