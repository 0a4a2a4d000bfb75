// Draws the lines across a map at the pointer, or where the scene is, or through the middle.
// See app/bearing_explorer/explorer/plots/plane.py. sideways: the line runs to the right; else upwards.
const {data} = image
const [left, bottom, width, height] = [data.x[0], data.y[0], data.dw[0], data.dh[0]]
const scene = mark.data.x.length ? [mark.data.x[0], mark.data.y[0]] : [left + width/2, bottom + height/2]
const [x, y] = cb_obj.event_name == "mousemove" ? [cb_obj.x, cb_obj.y] : scene
const at = place_on(image, null, 1, x, y)
if (!at || !said.data.words.length) return
const {rows, columns, row, column} = at
const grid = data.image[0]
const count = sideways ? columns : rows
const place = (k) => sideways ? left + (k + 0.5)*width/columns : bottom + (k + 0.5)*height/rows
const value = (k) => sideways ? grid[row*columns + k] : grid[k*columns + column]
line.data = {
  place: Float64Array.from({length: count}, (_, k) => place(k)),
  value: Float64Array.from({length: count}, (_, k) => value(k)),
}
const [middle, side] = sideways ? [at.y.middle, 2] : [at.x.middle, 1]
const {words, unit} = said.data
const number = String(Number(middle.toPrecision(4))).replace("-", "\u2212")
title.text = `${words[0]} at ${words[side]} ${number}${unit[side]}`
