// What can be grabbed in a drawing of the bearing: the ends and the middle of a defect, the tip of
// the arrow. It says how far each was turned and stretched; the controls move (see controls.js).
// See app/bearing_explorer/explorer/views/bearing_handles.py.
const NEAR = { mouse: 12, pen: 18, touch: 26 }  // [px]
const KINDS = ["start", "end", "middle", "load"]
const CUES = { start: "Drag: extent of the defect", end: "Drag: extent of the defect",
  middle: "Drag: place of the defect", load: "Drag: load and its direction" }
const view = plot.__grabbed?.el.isConnected ? null : Bokeh.index.find_one_by_id(plot.id)
if (view?.frame?.bbox?.width > 0) {
  plot.__grabbed = view
  const { el } = view
  let grabbed = null
  const place = ({ clientX, clientY }) => {
    const { left, top } = el.getBoundingClientRect(), { bbox } = view.frame
    const unit = bbox.width / (plot.x_range.end - plot.x_range.start)
    return { unit, x: plot.x_range.start + (clientX - left - bbox.left) / unit,
      y: plot.y_range.end - (clientY - top - bbox.top) / unit }
  }
  const nearest = (event, near) => {
    const at = place(event), { x, y, x0, kind, defect } = source.data
    let found = null, least = near / at.unit
    for (let i = 0; i < x.length; i++) {
      const far = Math.hypot(x[i] - at.x, y[i] - at.y)
      if (far < least) [least, found] = [far, { kind: KINDS[kind[i]], defect: defect[i], middle: x0[i] }]
    }
    return found
  }
  const say = (detail) => window.dispatchEvent(new CustomEvent("explorer-grabbed", { detail }))
  const polar = (event) => {
    const at = place(event)
    return { angle: Math.atan2(at.y, at.x - grabbed.middle), radius: Math.hypot(at.y, at.x - grabbed.middle) }
  }
  el.addEventListener("pointerdown", (event) => {
    grabbed = event.button === 0 ? nearest(event, NEAR[event.pointerType] ?? NEAR.mouse) : null
    if (!grabbed) return
    event.stopPropagation()
    event.preventDefault()
    el.setPointerCapture(event.pointerId)
    el.style.cursor = "grabbing"
    Object.assign(grabbed, { from: polar(event), last: polar(event), turn: 0 })
    say({ kind: grabbed.kind, defect: grabbed.defect, began: true })
  }, true)
  el.addEventListener("pointermove", (event) => {
    if (!grabbed) {
      const over = event.buttons ? null : nearest(event, NEAR.mouse)
      el.style.cursor = over ? "grab" : ""
      el.title = over ? CUES[over.kind] : ""
      return
    }
    event.stopPropagation()
    const at = polar(event)
    const by = at.angle - grabbed.last.angle
    grabbed.turn += Math.atan2(Math.sin(by), Math.cos(by)) * 180 / Math.PI
    grabbed.last = at
    say({ kind: grabbed.kind, defect: grabbed.defect, turn: grabbed.turn,
      stretch: at.radius / grabbed.from.radius })
  }, true)
  const end = (event) => {
    if (!grabbed) return
    event.stopPropagation()
    grabbed = null
    el.style.cursor = ""
    say({ released: true })
  }
  for (const kind of ["pointerup", "pointercancel"]) el.addEventListener(kind, end, true)
  // a finger on a handle drags it and does not scroll the page
  el.addEventListener("touchstart", (event) => {
    if (event.touches.length === 1 && nearest(event.touches[0], NEAR.touch)) event.preventDefault()
  }, { passive: false, capture: true })
}
