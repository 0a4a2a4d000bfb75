// Draws the lines across a map at the pointer, or where the scene is. See app/bearing_explorer/plotting/plane.py.
// sideways: the line runs to the right; else it runs upwards.
const data = image.data
const grid = data.image[0]
if (!grid || !grid.shape || grid.shape.length != 2) return
const [rows, columns] = grid.shape
const [left, bottom, width, height] = [data.x[0], data.y[0], data.dw[0], data.dh[0]]
const pointed = cb_obj.event_name == "mousemove"
let {x, y} = pointed ? cb_obj : {x: NaN, y: NaN}
if (!pointed && mark && mark.data.x.length) [x, y] = [mark.data.x[0], mark.data.y[0]]
const column = Math.floor((x - left)/width*columns)
const row = Math.floor((y - bottom)/height*rows)
if (!(0 <= column && column < columns && 0 <= row && row < rows)) return
const count = sideways ? columns : rows
const place = (k) => sideways ? left + (k + 0.5)*width/columns : bottom + (k + 0.5)*height/rows
const places = Float64Array.from({length: count}, (_, k) => place(k))
const values = Float64Array.from({length: count}, (_, k) => sideways ? grid[row*columns + k] : grid[k*columns + column])
line.data = {...line.data, [along]: places, [value]: values}
const at = sideways ? bottom + (row + 0.5)*height/rows : left + (column + 0.5)*width/columns
title.text = `${words} ${String(Number(at.toPrecision(4))).replace("-", "\u2212")}${unit}`
