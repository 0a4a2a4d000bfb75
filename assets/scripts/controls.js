// The controls beside the figures. What they share with other panels stands in rows.js, which is
// put in front of this file.

const TURN_RATE = 18      // degrees of cage angle a second while playing
const LARGEST_FILE = 1e6  // bytes of a measured floor

export function render({ model }) {
  const spec = model.spec
  const panel = make_rows(model)
  const { rows, control, choice, send } = panel

  const play = (name) => {
    const button = element("button", { type: "button", class: "play", "aria-pressed": "false" })
    let last = 0, playing = false
    const show = () => {
      button.setAttribute("aria-pressed", String(playing))
      button.setAttribute("aria-label", playing ? "Stop turning" : "Turn the bearing")
      button.title = playing ? "Stop" : "Turn the bearing"
      button.innerHTML = playing
        ? '<svg viewBox="0 0 12 12" aria-hidden="true"><path d="M2 1h3v10H2zM7 1h3v10H7z"/></svg>'
        : '<svg viewBox="0 0 12 12" aria-hidden="true"><path d="M2.5 1v10l8-5z"/></svg>'
    }
    const turn = (now) => {
      if (!playing || !button.isConnected) return
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
    button.addEventListener("click", () => {
      playing = !playing
      if (!playing) panel.release()
      show()
      last = performance.now()
      if (playing) requestAnimationFrame(turn)
    })
    const heard = () => {  // the space bar, see page.js
      if (button.isConnected) button.click()
      else window.removeEventListener("explorer-play", heard)
    }
    window.addEventListener("explorer-play", heard)
    show()
    return button
  }

  // The defects: which one the sliders move, one more, one less.
  const defects = element("div", { class: "defects", role: "group", "aria-label": "Defects" })
  const list_defects = ({ names, selected, most }) => {
    const focused = defects.getRootNode().activeElement
    const kept = defects.contains(focused) ? focused.dataset.choose : null
    defects.replaceChildren(...names.map((name, index) => {
      const chip = element("button", {
        type: "button", class: "chip", "data-choose": String(index),
        "aria-pressed": String(index === selected), title: `The sliders move defect ${index + 1}: ${name}`,
        "aria-label": `Defect ${index + 1}, ${name}`,
      }, String(index + 1))
      return chip
    }))
    const add = element("button", {
      type: "button", class: "chip", "data-choose": "add", "aria-label": "Add a defect",
      title: "Add a defect",
    }, "+")
    const remove = element("button", {
      type: "button", class: "chip", "data-choose": "remove", title: `Remove defect ${selected + 1}`,
      "aria-label": `Remove defect ${selected + 1}`,
    }, "\u2212")
    add.disabled = names.length >= most
    remove.disabled = names.length < 2
    defects.append(add, remove)
    const again = kept && defects.querySelector(`[data-choose="${kept}"]:not(:disabled)`)
    if (kept) (again ?? defects.querySelector('[aria-pressed="true"]')).focus()
  }
  defects.addEventListener("click", (event) => {
    const chosen = event.target.closest("button")?.dataset.choose
    if (chosen !== undefined) send({ choose: { defect: chosen } })
  })

  // A measured floor: the file is read here, sent as text, and judged by the server.
  const upload = () => {
    const file = element("input", { type: "file", accept: ".csv,.txt,.dat,.tsv,text/plain",
      id: "floor-file", "aria-describedby": "floor-words" })
    const words = element("p", { class: "note", id: "floor-words", role: "status" })
    const label = element("label", { for: "floor-file" }, "Two columns: angle in °, depth in µm, or in the units of its headings")
    file.addEventListener("change", async () => {
      const chosen = file.files[0]
      if (!chosen) return
      if (chosen.size > LARGEST_FILE) {
        say(`${chosen.name} is larger than ${LARGEST_FILE / 1e6} MB.`, true)
      } else {
        say(`Reading ${chosen.name} \u2026`)
        send({ floor: { name: chosen.name, text: await chosen.text() } })
      }
      file.value = ""  // so that the same file, mended, can be chosen again
    })
    const say = (sentence, bad = false) => {
      words.textContent = sentence
      words.classList.toggle("bad", bad)
    }
    return { root: element("div", { class: "upload" }, label, file, words), say }
  }
  const floor = upload()

  const take = (state) => {
    panel.take(state)
    if (state.defects) list_defects(state.defects)
    if (state.floor) {
      floor.root.hidden = !state.floor.shown
      floor.say(state.floor.words, state.floor.bad)
    }
  }

  // What is clicked at in a figure goes the way of typed numbers.
  const typed = (event) => {
    if (form.isConnected) send({ typed: event.detail })
    else window.removeEventListener("explorer-typed", typed)
  }
  window.addEventListener("explorer-typed", typed)
  const form = element("form", { "aria-label": "Scene" }, choice("preset"))
  form.addEventListener("submit", (event) => event.preventDefault())
  for (const group of spec.groups) {
    const own = Object.keys(spec.choices).filter((name) => spec.choices[name].group === group.title)
    const box = element("fieldset", {}, element("legend", {}, group.title))
    if (group.title === spec.defects) box.append(defects)
    box.append(...own.filter((name) => spec.choices[name].first).map((name) => choice(name)))
    const after = group.controls.filter(({ name }) => spec.last.includes(name))
    box.append(...group.controls.filter((entry) => !after.includes(entry)).map(control))
    box.append(...own.filter((name) => !spec.choices[name].first).map((name) => choice(name)))
    box.append(...after.map(control))
    if (group.title === spec.defects) box.append(floor.root)
    form.append(box)
  }
  if (rows[spec.turning]) rows[spec.turning].line.prepend(play(spec.turning))

  // With a lesson only the controls that it speaks of, and all others when asked for.
  const all = element("button", { type: "button", class: "all", "aria-expanded": "false" })
  form.append(all)
  let named = null, whole = false
  const put_aside = () => {
    const few = named !== null && named.length > 0 && !whole
    const shown = (name) => !few || named.includes(name)
    for (const [name, { root }] of [...Object.entries(rows), ...Object.entries(panel.selects)])
      root.classList.toggle("put-aside", !shown(name))
    for (const box of form.querySelectorAll("fieldset"))
      box.classList.toggle("put-aside", few && !box.querySelector(".control:not(.put-aside), .choice:not(.put-aside)"))
    form.classList.toggle("few", few)
    all.hidden = named === null
    all.textContent = few ? "All controls" : "Only those of the lesson"
    all.setAttribute("aria-expanded", String(!few))
  }
  all.addEventListener("click", () => { whole = !whole; put_aside() })
  const lesson = (event) => {
    if (!form.isConnected) return window.removeEventListener("explorer-lesson", lesson)
    named = event.detail?.drag ?? null
    whole = false
    put_aside()
  }
  window.addEventListener("explorer-lesson", lesson)
  put_aside()
  take(model.state)
  panel.listen(take)
  return form
}
