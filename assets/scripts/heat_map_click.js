// A click on a heat map goes there, the way of typed numbers (see controls.js): to the middle of
// the cell clicked at, or with `digits` to the very place, rounded.
const at = place_on(image, stands, count, cb_obj.x, cb_obj.y)
if (at) {
  const exact = (side) => Math.max(0, side.value)
  const whole = (value) => Number(Math.max(0, value).toFixed(digits))
  const of = (side, turned) => digits === null ? Number(turned(side.middle).toPrecision(6))
    : whole(turned(exact(side)))
  const typed = {}
  const {name: x} = sides[at.x.which], {name: y} = sides[at.y.which]
  if (x) typed[x] = of(at.x, (value) => at.start + value/at.turn)
  if (y) typed[y] = of(at.y, (value) => value)
  window.dispatchEvent(new CustomEvent("explorer-typed", {detail: typed}))
}
