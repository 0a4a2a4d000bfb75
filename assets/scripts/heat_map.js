// A picture of numbers on a grid, out of the packed column of the packed source. See app/bearing_explorer/kit/plots/heat_map.py.
const p = cb_obj.data.packed
if (p.length > head) {
  const [columns, rows, left, width, bottom, height, faint, across, up] = p
  const size = columns*rows
  layers.forEach((layer, k) => {
    const Grid = layer.data.image[0].constructor
    const values = p.slice(head + k*size, head + (k + 1)*size)
    layer.data = {
      image: [new Grid(values, [rows, columns])],
      x: [left], y: [bottom], dw: [width], dh: [height], alpha: [faint],
    }
  })
  stands.data = {across: [across], up: [up]}
  for (const [axis, which] of [[x_axis, across], [y_axis, up]])
    if (axis.axis_label != labels[which]) axis.axis_label = labels[which]
}
