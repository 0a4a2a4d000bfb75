// A click in a map asks for its extent and cage angle. See app/bearing_explorer/views/maps.py.
const {x, y} = cb_obj
const box = boxes.find(([left, right, bottom, top]) =>
  left <= x && x <= right && bottom <= y && y <= top)
const ends = Object.fromEntries(Object.entries(grid.data).map(([name, column]) => [name, column[0]]))
if (box && ends.turn) {
  const between = (first, last, share) =>
    Math.min(last, Math.max(first, first + share*(last - first)))
  const extent = between(ends.first_extent, ends.last_extent, (y - box[2])/(box[3] - box[2]))
  const angle = between(ends.first_angle, ends.last_angle, (x - box[0])/(box[1] - box[0]))
  const whole = (value) => Number(Math.max(0, value).toFixed(1))
  window.dispatchEvent(new CustomEvent("explorer-typed", {detail: {
    extent_deg: whole(extent),
    cage_angle_deg: whole(ends.start + Math.max(0, angle)/ends.turn),
  }}))
}
