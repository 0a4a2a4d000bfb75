// The controls beside the figures. What they share with other panels is in rows.js, which is put in
// front of this file.

const TURN_RATE = 18      // degrees of cage angle a second while playing
const LARGEST_FILE = 1e6  // bytes of a measured floor
const PLAY = "M2.5 1v10l8-5z", PAUSE = "M2 1h3v10H2zM7 1h3v10H7z"

export function render({ model }) {
  const spec = model.spec
  const panel = make_rows(model)
  const { rows, send } = panel

  // Turns the bearing until it is pressed again.
  const play = (name) => {
    let last = 0, playing = false
    const toggle = button("", () => {
      playing = !playing
      if (!playing) panel.release()
      show()
      last = performance.now()
      if (playing) requestAnimationFrame(turn)
    }, { class: "play" })
    const show = () => {
      toggle.setAttribute("aria-pressed", String(playing))
      toggle.setAttribute("aria-label", playing ? "Stop turning" : "Turn the bearing")
      toggle.title = playing ? "Stop" : "Turn the bearing"
      toggle.innerHTML = `<svg viewBox="0 0 12 12" aria-hidden="true"><path d="${playing ? PAUSE : PLAY}"/></svg>`
    }
    const turn = (now) => {
      if (!playing || !toggle.isConnected) return
      const passed = Math.min(now - last, 250)
      // The next angle is asked for when the last one is drawn: turning never outruns drawing.
      if (panel.drawn() && passed >= 30) {
        last = now
        const angle = Number(((panel.values[name] + TURN_RATE * passed / 1000) % 360).toFixed(3))
        panel.put(name, angle)
        rows[name].number.value = format(Number(angle.toFixed(1)), panel.limits[name].step)
        panel.push(name, angle)
      }
      requestAnimationFrame(turn)
    }
    on_event("play", toggle, () => toggle.click())  // the space bar, see page.js
    show()
    return toggle
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

  // A measured floor: the file is read here, sent as text, and checked by the server.
  const file = element("input", { type: "file", accept: ".csv,.txt,.dat,.tsv,text/plain",
                                  id: "floor-file", "aria-describedby": "floor-words" })
  const words = element("p", { class: "note", id: "floor-words", role: "status" })
  sends_text(file, LARGEST_FILE, (...said) => write_note(words, ...said), (floor) => send({ floor }))
  const floor = element("div", { class: "upload" }, element("label", { for: "floor-file" },
    "Two columns: angle in °, depth in µm, or in the units of its headings"), file, words)

  const boxes = spec.groups.map((group) => panel.group_box(group, spec.last))
  for (const box of boxes.filter((box) => box.dataset.group === spec.defects)) {
    box.firstChild.after(defects)
    box.append(floor)
  }
  const all = button("", () => { whole = !whole; show_named() }, { class: "all" })
  const form = panel.form({ "aria-label": "Scene" }, panel.choice("preset"), ...boxes, all)
  rows[spec.turning]?.line.prepend(play(spec.turning))

  // With a lesson only the controls that it names, and all others on request.
  let named = null, whole = false
  const show_named = () => {
    const few = named !== null && named.length > 0 && !whole
    for (const [name, { root }] of Object.entries({ ...rows, ...panel.selects }))
      root.classList.toggle("put-aside", few && !named.includes(name))
    form.classList.toggle("few", few)  // boxes without a control go by the style sheet
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
  show_named()
  const take = (state) => {
    panel.take(state)
    if (state.defects) list_defects(state.defects)
    if (state.floor) {
      floor.hidden = !state.floor.shown
      write_note(words, state.floor.words, state.floor.bad)
    }
  }
  take(model.state)
  panel.listen(take)
  return form
}
