// A picture of numbers on a grid, out of the packed column of the packed source. See app/bearing_explorer/kit/plots/heat_map.py.
const p = cb_obj.data.packed
if (p.length) {
  const [columns, rows, left, width, bottom, height, faint] = p
  const Grid = image.data.image[0].constructor
  image.data = {
    image: [new Grid(p.slice(7), [rows, columns])],
    x: [left], y: [bottom], dw: [width], dh: [height], alpha: [faint],
  }
}
