// The controls beside the figures. What they share with other panels is in rows.js, which is put in
// front of this file.

const TURN_RATE = 18      // degrees of cage angle a second while playing
const IDLE_RATE = 6       // the same by itself, but not while a hand is at work ...
const IDLE_TIME = 60e3    // ms, and so long after the last touch
const HAND_TIME = 2500    // ms after a touch in which what it changed is seen, and read out, at rest
const IDLE_STEP = 80      // ms between two angles then, half a degree ...
const IDLE_PAUSE = 10     // ... and times what a picture takes the server, which many pages may share
const TOUCHES = ["pointerdown", "pointerup", "pointercancel", "keydown", "wheel"]
const LENGTHENING = 1200  // ms in which the defect grows by a ball spacing
const PLAY = "M2.5 1v10l8-5z", PAUSE = "M2 1h3v10H2zM7 1h3v10H7z"

export function render({ model }) {
  const spec = model.spec
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches
  const panel = make_rows(model, { changed: (name) => {
    count_changed()
    if (name === spec.extent) show_cue()
  } })
  const { rows, values, send } = panel

  // Turns the bearing until it is pressed again. A page that is opened without a scene turns it by
  // itself, which is no step to undo, and goes on after a change: balls are seen to cross the defect.
  const play = (name) => {
    let last = 0, playing = false, idle = false, at_work = 0, ending = 0
    const set_playing = (wanted, by_itself = false) => {
      if (playing && !wanted) idle ? send({ set: {}, turning: true, released: true }) : panel.release()
      playing = wanted
      idle = by_itself
      toggle.setAttribute("aria-pressed", String(playing))
      toggle.setAttribute("aria-label", playing ? "Stop turning" : "Turn the bearing")
      toggle.title = playing ? "Stop" : "Turn the bearing"
      toggle.innerHTML = `<svg viewBox="0 0 12 12" aria-hidden="true"><path d="${playing ? PAUSE : PLAY}"/></svg>`
      announce("turning", idle)
      last = performance.now()
      if (playing) next()
    }
    // By itself it turns a few times a second, and asks for no frames in between.
    const pause = () => idle ? Math.max(IDLE_STEP, 1000 * IDLE_PAUSE * window.__worked) : 30
    const next = () => {
      const frame = () => requestAnimationFrame(turn)
      idle ? setTimeout(frame, last + pause() - performance.now()) : frame()
    }
    const toggle = button("", () => set_playing(!playing), { class: "play" })
    const turn = (now) => {
      if (!playing || !toggle.isConnected) return
      if (idle && now < at_work) {
        last = now
        return next()
      }
      if (idle && at_work) {
        at_work = 0
        announce("turning", true)
      }
      const passed = now - last
      // The next angle is asked for when the last one is drawn: turning never outruns drawing.
      if (panel.drawn() && passed >= pause()) {
        last = now
        const by = (idle ? IDLE_RATE : TURN_RATE) * Math.min(passed, 250) / 1000
        const angle = Number(((values[name] + by) % 360).toFixed(3))
        panel.put(name, angle)
        rows[name].number.value = format(Number(angle.toFixed(1)), panel.limits[name].step)
        idle ? send({ set: { [name]: angle }, turning: true }) : panel.push(name, angle)
      }
      next()
    }
    const wait = (event) => {  // space and the button stop it themselves
      if (!idle || event.key === " " || event.composedPath().includes(toggle)) return
      if (!at_work) announce("turning", false)
      at_work = event.type === "pointerdown" ? Infinity : performance.now() + HAND_TIME
      end_later()
    }
    const end_later = () => {
      clearTimeout(ending)
      ending = setTimeout(() => { if (idle) set_playing(false) }, IDLE_TIME)
    }
    const begin = () => {
      removeEventListener("explorer-drawn", begin)
      if (still || location.search || document.documentElement.hasAttribute("data-lesson")) return
      for (const kind of TOUCHES) addEventListener(kind, wait, true)
      end_later()
      set_playing(true, true)
    }
    addEventListener("explorer-drawn", begin)
    for (const name of ["tab", "lesson"])  // which look at other things
      on_event(name, toggle, (what) => { if (idle && what && what !== "overview") set_playing(false) })
    on_event("play", toggle, () => toggle.click())  // the space bar, see page.js
    set_playing(false)
    return toggle
  }

  // Lengthens the defect by a ball spacing, as a hand would.
  let spacing = 0
  const lengthen = () => {
    const name = spec.extent, from = values[name], began = performance.now()
    const to = Math.min(from + spacing, panel.limits[name].most)
    const step = (now) => {
      const share = still ? 1 : Math.min(1, Math.max(0, now - began) / LENGTHENING)
      if (share === 1 || panel.drawn()) panel.move(name, Number((from + share * (to - from)).toFixed(2)))
      share < 1 ? requestAnimationFrame(step) : panel.release()
    }
    if (to > from) requestAnimationFrame(step)
  }

  // What is dragged in a drawing of the bearing (see grab.js) moves the sliders.
  let selected = 0, hold = null
  let pointed = -Math.PI / 2  // direction of the last load, in which one of nothing grows
  const inside = (name, value) => {
    const { least, most } = panel.limits[name]
    return Math.min(most, Math.max(least, Number(value.toPrecision(4))))
  }
  const around = (name, value) => {
    const { least } = panel.limits[name]
    return Number((least + (((value - least) % 360) + 360) % 360).toFixed(2))
  }
  const greatest_load = (angle) => Math.min(panel.limits.fx_n.most / Math.abs(Math.cos(angle)), panel.limits.fy_n.most / Math.abs(Math.sin(angle)))
  const follow_hand = ({ kind, defect, began, released, turn, force, more, to, hear }) => {
    if (began) {
      if (kind === "load") hear?.(Math.round(greatest_load(values.fx_n || values.fy_n ? Math.atan2(values.fy_n, values.fx_n) : pointed)))
      const own = kind === "load" || defect === selected
      hold = own ? { ...values, turn: 0, pointed } : null
      if (!own) send({ choose: { defect: String(defect) } })
      return
    }
    if (released) return hold && panel.release()
    if (kind !== "load" && defect !== selected) return  // not before the sliders are its own
    hold ??= { ...values, turn, pointed }
    const by = turn - hold.turn
    if (kind === "load") {
      const held = Math.hypot(hold.fx_n, hold.fy_n)
      const angle = (held ? Math.atan2(hold.fy_n, hold.fx_n) : hold.pointed) + by * Math.PI / 180
      pointed = force ? Math.atan2(force[1], force[0]) : angle
      const size = to ? { least: 0, most: greatest_load(angle) }[to] : force ? Math.hypot(...force) : Math.max(0, held + more)
      const [fx_n, fy_n] = (force ?? [size * Math.cos(angle), size * Math.sin(angle)]).map((one) => Math.abs(one) < 0.01 * size ? 0 : one)  // by hand nothing is upright
      panel.move_all({ fx_n: inside("fx_n", fx_n), fy_n: inside("fy_n", fy_n) })
    } else if (kind === "middle") panel.move("center_deg", to ? panel.limits.center_deg[to] : around("center_deg", hold.center_deg + by))
    else {
      const side = kind === "end" ? 1 : -1
      const limits = panel.limits[spec.extent]  // one of no length would have no ends to hold
      const extent = to ? Math.max(limits[to], limits.step) : inside(spec.extent, hold[spec.extent] + side * by)
      const center = hold.center_deg + side * (extent - hold[spec.extent]) / 2
      panel.move_all({ [spec.extent]: extent, center_deg: around("center_deg", center) })
    }
  }

  // The defects: which one the sliders move, one more, one less.
  const defects = element("div", { class: "defects", role: "group", "aria-label": "Defects" })
  const list_defects = ({ names, selected, most }) => {
    const focused = defects.getRootNode().activeElement
    const kept = defects.contains(focused) ? focused.dataset.choose : null
    const chip = (what, text, label, title = label, pressed = null) =>
      button(text, () => send({ choose: { defect: what } }), { class: "chip", "data-choose": what, title,
        "aria-label": label, ...(pressed === null ? {} : { "aria-pressed": String(pressed) }) })
    const add = chip("add", "+", "Add a defect")
    const remove = chip("remove", "\u2212", `Remove defect ${selected + 1}`)
    add.disabled = names.length >= most
    remove.disabled = names.length < 2
    defects.replaceChildren(...names.map((name, index) => chip(String(index), String(index + 1),
      `Defect ${index + 1}, ${name}`, `The sliders move defect ${index + 1}: ${name}`, index === selected)), add, remove)
    const again = kept && defects.querySelector(`[data-choose="${kept}"]:not(:disabled)`)
    if (kept) (again ?? defects.querySelector('[aria-pressed="true"]')).focus()
  }

  const search = bearing_search(model, panel)
  panel.selects.preset = search
  // A few sliders, and all others folded, with a count of those that are not as the bearing has them.
  const is_main = ({ name }) => spec.main.includes(name)
  const all_of = spec.groups.flatMap(({ controls }) => controls)
  const main = element("div", { class: "main" },
    ...spec.main.map((name) => panel.control(all_of.find((one) => one.name === name))))
  const boxes = spec.groups.map(({ title, controls }) =>
    panel.group_box({ title, controls: controls.filter((one) => !is_main(one)) }, spec.last))
  const box_of_defects = boxes.find((box) => box.dataset.group === spec.defects)
  box_of_defects.firstChild.after(defects)
  const rest = element("div", { class: "rest", id: "more-controls" }, ...boxes)
  const more = button("", () => { unfolded = !unfolded; show_named() },
    { class: "more", "aria-controls": "more-controls" })
  const toggle = play(spec.turning)
  const tools = element("div", { class: "tools" }, toggle, more)
  const all = button("", () => { whole = !whole; show_named() }, { class: "all" })
  const form = panel.form({ "aria-label": "Scene" }, search.root, main, tools, rest, all)

  // Ball spacings on the slider of the length, and a cue as a hand crosses one.
  const cue = element("p", { class: "cue", role: "status" }), row = rows[spec.extent]
  row.root.append(cue)
  row.slider.classList.add("spaced")
  let inside_before = null, flash  // of its opacity, one at a time: else all of the page is painted at each frame
  const show_cue = () => {
    const count = Math.floor(values[spec.extent] / spacing + 1e-9)
    if (count === inside_before) return
    cue.textContent = count ? `${count === 1 ? "One rolling element" : `${count} rolling elements`} always inside` : ""
    flash?.cancel()
    if (inside_before !== null && !still) flash = cue.animate({ opacity: [0.7, 0] }, { duration: 1200, pseudoElement: "::after" })
    inside_before = count
  }

  let usual = {}, many = 1
  const count_changed = () => {
    const differs = (name, value) => usual[name] !== undefined && value !== usual[name]
    const changed = many - 1 + all_of.filter(({ name }) => name !== spec.turning && differs(name, values[name])).length
      + Object.entries(panel.selects).filter(([name, { select }]) => differs(name, select.value)).length
    const words = changed ? `All settings (${changed} changed)` : "All settings"
    if (more.textContent !== words) more.textContent = words
  }

  // With a lesson only the controls that it names, and all others on request.
  let named = null, whole = false, unfolded = false
  const show_named = () => {
    const few = named !== null && named.length > 0 && !whole
    for (const [name, { root }] of Object.entries({ ...rows, ...panel.selects }))
      root.classList.toggle("put-aside", few && !named.includes(name))
    form.classList.toggle("few", few)  // boxes without a control go by the style sheet
    rest.hidden = !few && !unfolded
    more.hidden = few
    more.setAttribute("aria-expanded", String(unfolded))
    toggle.hidden = few && !named.includes(spec.turning)
    all.hidden = named === null
    all.textContent = few ? "All controls" : "Only those of the lesson"
    all.setAttribute("aria-expanded", String(!few))
  }
  on_event("lesson", form, (lesson) => {
    named = lesson?.drag ?? null
    whole = false
    show_named()
  })
  on_event("typed", form, (typed) => send({ typed }))  // what is clicked at in a figure
  on_event("grabbed", form, follow_hand)
  on_event("longer", form, lengthen)
  show_named()
  const take = (state) => {
    Object.assign(usual, state.usual ?? {})
    spacing = 360 / (state.values.n_balls ?? 360 / spacing)
    panel.take(state)
    search.follow_state(state)
    if (state.defects) {
      many = state.defects.names.length
      selected = state.defects.selected
      list_defects(state.defects)
    }
    const { least, most } = panel.limits[spec.extent]
    row.slider.style.setProperty("--spacing", spacing / (most - least))
    row.slider.title = `Ticks: rolling elements are ${spacing.toFixed(1)}\u00b0 apart`
    show_cue()
    count_changed()
  }
  take(model.state)
  panel.listen(take)
  return form
}
