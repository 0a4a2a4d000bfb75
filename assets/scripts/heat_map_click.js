// A click on a heat map goes there, the way of typed numbers (see controls.js): to the middle of
// the cell clicked at, or with `digits` to the very place, rounded.
//
// Two clicks bring a figure that is zoomed back. Such a figure waits whether a second one follows,
// which Bokeh tells from two single ones by the same time; any other goes there at once.
const SECOND_CLICK = 320  // ms
const clicks = (window.__map_clicks ??= new WeakMap())
const is_zoomed = ({x_range, y_range}) => [x_range, y_range].some((range) =>
  range.reset_start !== range.start || range.reset_end !== range.end)
const go = () => {
  const at = place_on(image, stands, count, cb_obj.x, cb_obj.y)
  if (!at) return
  const of = (side, turned) => digits === null ? Number(turned(side.middle).toPrecision(6))
    : Number(Math.max(0, turned(Math.max(0, side.value))).toFixed(digits))
  const typed = {}
  const {name: x, sign: turns_x} = sides[at.x.which], {name: y, sign: turns_y} = sides[at.y.which]
  if (x) typed[x] = turns_x*of(at.x, (value) => at.start + value/at.turn)
  if (y) typed[y] = turns_y*of(at.y, (value) => value)
  window.dispatchEvent(new CustomEvent("explorer-typed", {detail: typed}))
}
clearTimeout(clicks.get(image))
if (cb_obj.event_name === "tap") {
  if (is_zoomed(cb_obj.origin)) clicks.set(image, setTimeout(go, SECOND_CLICK))
  else go()
}
