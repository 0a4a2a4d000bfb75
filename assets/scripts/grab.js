// What can be grabbed in a drawing of the bearing: the ends and the middle of a defect, the tip of
// the arrow. It says how far each was turned and which force the arrow is; the controls move (see
// controls.js). By keys a handle is a slider: Tab comes to it, arrow keys move it the way they point, Home
// and End go to the least and greatest value; of the arrow these, up and down change the size.
// See app/bearing_explorer/explorer/views/bearing_handles.py.
const NEAR = { mouse: 12, pen: 18, touch: 26 }  // [px]
const CUED = 36  // [px] of the radius of a bore in which there is room for the cue
const KINDS = ["start", "end", "middle", "load"]
const NAMES = { start: "Beginning of the defect", end: "End of the defect", middle: "Place of the defect", load: "Load" }
const STEP = 0.5          // [°] a key turns a handle by, ten times as much with Page up and down ...
const LARGER = 0.05       // ... and what it adds to a load
const GRABBED = "bearing-explorer.grabbed"
const LOOK = `
.handle { position: absolute; left: 0; top: 0; width: 18px; height: 18px; margin: -9px; border-radius: 50%; pointer-events: none; outline: none; }
.handle:focus-visible { outline: 3px solid var(--accent); outline-offset: 1px; }
.cue { position: absolute; left: 0; top: 0; width: 66px; margin: -1.3em -33px; font: 11px/1.25 var(--font); text-align: center; color: var(--ink-soft); pointer-events: none; }
.cue::after { content: attr(data-words); }`
if (plot.__grabbed?.el.isConnected) plot.__grabbed.place_handles()
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
    const at = place(event), { x, y, x0, kind, defect, newtons } = source.data
    let found = null, least = near / at.unit
    for (let i = 0; i < x.length; i++) {
      const far = Math.hypot(x[i] - at.x, y[i] - at.y)
      if (far < least) [least, found] = [far, { kind: KINDS[kind[i]], defect: defect[i], middle: x0[i], newtons: newtons[i],
        off: { x: x[i] - x0[i] - at.x, y: y[i] - at.y } }]
    }
    return found
  }
  const say = (detail) => {
    if (detail.began && detail.hand !== false) {
      try { localStorage.setItem(GRABBED, "1") } catch { /* said again next time */ }
      cue.hidden = true
    }
    window.dispatchEvent(new CustomEvent("explorer-grabbed", { detail }))
  }
  // the handles for keys, which lie over those that are drawn, and a cue where the arrow is not
  const handles = [], cue = document.createElement("div"), look = document.createElement("style")
  look.textContent = LOOK
  cue.className = "cue"
  cue.setAttribute("aria-hidden", "true")
  try { cue.hidden = localStorage.getItem(GRABBED) !== null } catch { /* then it is said */ }
  view.shadow_el.append(look, cue)
  const attribute = (element, name, value) => {
    if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value)
  }
  const make_handle = () => {
    const one = document.createElement("div")
    one.className = "handle"
    for (const [name, value] of [["role", "slider"], ["tabindex", "0"], ["aria-valuemin", "0"]]) one.setAttribute(name, value)
    let moved = null
    const done = () => {
      if (moved) say({ released: true })
      moved = null
    }
    const hear = (most) => attribute(one, "aria-valuemax", one.most = most)  // of a load, which its sliders know
    one.addEventListener("focus", () => say({ kind: one.kind, defect: one.defect, began: true, hand: false, hear }))
    one.addEventListener("keydown", (event) => {
      const to = { Home: "least", End: "most" }[event.key]
      const side = { ArrowRight: 1, ArrowUp: 1, PageUp: 10, ArrowLeft: -1, ArrowDown: -1, PageDown: -10 }[event.key]
      if (!(side || to) || event.ctrlKey || event.altKey || event.metaKey) return
      event.preventDefault()
      event.stopPropagation()
      if (!moved) say({ kind: one.kind, defect: one.defect, began: true })
      moved ??= { turn: 0, more: 0, step: LARGER * (one.size || one.whole) }
      const across = /Left|Right/.test(event.key), angle = one.angle * Math.PI / 180
      if (one.kind === "load" && !across) moved.more += side * moved.step
      else if (side) {
        const way = across ? -Math.sin(angle) : Math.cos(angle)  // of a turn to the left, on screen
        moved.turn += side * STEP * (way < -0.1 ? -1 : 1) * (one.kind === "load" ? 2 : 1)
      }
      say({ kind: one.kind, defect: one.defect, turn: moved.turn, more: moved.more, to })
    })
    one.addEventListener("keyup", done)
    one.addEventListener("blur", done)
    view.shadow_el.append(one)
    return one
  }
  view.place_handles = () => {
    const { x, y, x0, kind, defect, value, angle, bore, newtons } = source.data, { bbox } = view.frame
    const unit = bbox.width / (plot.x_range.end - plot.x_range.start)
    const at = (right, up) => `translate(${(bbox.left + (right - plot.x_range.start) * unit).toFixed(1)}px, ${(bbox.top + (plot.y_range.end - up) * unit).toFixed(1)}px)`
    while (handles.length > x.length) handles.pop().remove()
    while (handles.length < x.length) handles.push(make_handle())
    attribute(cue, "data-words", kind.some((one) => KINDS[one] !== "load") ? "drag arrow or defect" : "drag arrow")
    handles.forEach((one, i) => {
      const number = Number(value[i].toPrecision(3)), place = Number(angle[i].toPrecision(3)) % 360
      Object.assign(one, { kind: KINDS[kind[i]], defect: defect[i], size: value[i], angle: angle[i], whole: bore[i] * newtons[i] })
      one.style.transform = at(x[i], y[i])
      const load = one.kind === "load", middle = one.kind === "middle"
      attribute(one, "aria-label", NAMES[one.kind])
      attribute(one, "aria-valuenow", load ? number : place)
      attribute(one, "aria-valuemax", load ? Math.max(number, one.most ?? 0) : 360)
      attribute(one, "aria-valuetext", load ? number ? `${number} N at ${place}\u00b0` : "0 N" : middle ? `at ${place}\u00b0`
        : `at ${place}\u00b0; defect ${number}\u00b0 long`)
      if (!load) return
      const large = document.documentElement.hasAttribute("data-projector")
      cue.style.visibility = large || unit * bore[i] < CUED ? "hidden" : ""
      const turn = angle[i] * Math.PI / 180, far = -0.4 * bore[i]  // on the other side than the arrow
      cue.style.transform = at(x0[i] + far * Math.cos(turn), far * Math.sin(turn))
    })
  }
  view.place_handles()
  const angle_of = (event) => {
    const at = place(event)
    return Math.atan2(at.y, at.x - grabbed.middle)
  }
  el.addEventListener("pointerdown", (event) => {
    grabbed = event.button === 0 ? nearest(event, NEAR[event.pointerType] ?? NEAR.mouse) : null
    if (!grabbed) return
    event.stopPropagation()
    event.preventDefault()
    el.setPointerCapture(event.pointerId)
    el.style.cursor = event.composedPath()[0].style.cursor = "grabbing"
    Object.assign(grabbed, { last: angle_of(event), turn: 0 })
    say({ kind: grabbed.kind, defect: grabbed.defect, began: true })
  }, true)
  el.addEventListener("pointermove", (event) => {
    if (!grabbed) {
      const over = event.buttons ? null : nearest(event, NEAR.mouse)
      el.style.cursor = over ? "grab" : ""
      el.title = over ? `Drag: ${NAMES[over.kind]}` : ""
      return
    }
    event.stopPropagation()
    const { x, y } = place(event), { off, newtons } = grabbed, angle = angle_of(event)
    const by = angle - grabbed.last
    grabbed.turn += Math.atan2(Math.sin(by), Math.cos(by)) * 180 / Math.PI
    grabbed.last = angle
    const force = [newtons * (x + off.x), newtons * (y + off.y)]  // its tip stays under the hand
    say({ kind: grabbed.kind, defect: grabbed.defect, turn: grabbed.turn, force })
  }, true)
  el.addEventListener("pointermove", (event) => {  // after Bokeh, whose layer above all has a cursor of its own
    if (el.style.cursor) event.composedPath()[0].style.cursor = el.style.cursor
  })
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
    const alone = event.touches.length === 1 && event.cancelable
    if (alone && nearest(event.touches[0], NEAR.touch)) event.preventDefault()
  }, { passive: false, capture: true })
}
