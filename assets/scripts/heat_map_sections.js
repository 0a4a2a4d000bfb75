// Draws the lines across a map at the pointer, or where the scene is.
// See app/bearing_explorer/plots/plane.py. sideways: the line runs to the right; else upwards.
const pointed = cb_obj.event_name == "mousemove"
let {x, y} = pointed ? cb_obj : {x: NaN, y: NaN}
if (!pointed && mark && mark.data.x.length) [x, y] = [mark.data.x[0], mark.data.y[0]]
const at = place_on(image, null, 1, x, y)
if (!at) return
const {rows, columns, row, column} = at
const {data} = image
const [left, bottom, width, height] = [data.x[0], data.y[0], data.dw[0], data.dh[0]]
const grid = data.image[0]
const count = sideways ? columns : rows
const place = (k) => sideways ? left + (k + 0.5)*width/columns : bottom + (k + 0.5)*height/rows
const places = Float64Array.from({length: count}, (_, k) => place(k))
const values = Float64Array.from({length: count}, (_, k) => sideways ? grid[row*columns + k] : grid[k*columns + column])
line.data = {...line.data, [along]: places, [value]: values}
const middle = (sideways ? at.y : at.x).middle
title.text = `${words} ${String(Number(middle.toPrecision(4))).replace("-", "\u2212")}${unit}`
