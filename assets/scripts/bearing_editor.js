// The bearing: every dimension, and a picture that shows what each one is. rows.js and
// bearing_picture.js are put in front of this file.

export function render({ model }) {
  const spec = model.spec
  const about = element("p", { class: "about", "aria-hidden": "true" })
  let last = ""
  const touched = (name) => {
    if (name === last) return
    last = name
    drawing.mark(name)
    const { label, symbol, about: sentence } = panel.rows[name]
    about.innerHTML = `<strong>${label} <i class="symbol">${symbol}</i></strong> `
    about.append(sentence)
  }
  const panel = make_rows(model, { touched })
  const drawing = bearing_picture((name) => {
    const row = panel.rows[name]
    if (row && !row.root.hidden) row.number.focus()
    else if (row) touched(name)
  })

  const fields = element("form", { class: "fields", "aria-label": "Dimensions of the bearing" })
  fields.addEventListener("submit", (event) => event.preventDefault())
  // What the bearing is called, by whoever changed it.
  const called = element("input", { type: "text", id: "bearing-name", maxlength: "60",
    autocomplete: "off", spellcheck: "false" })
  called.addEventListener("change", () => panel.send({ choose: { name: called.value } }))
  // Dimensions that wait until they fit together.
  const waits = element("div", { class: "waits", role: "status", hidden: "" })
  const words = element("p", {})
  const discard = element("button", { type: "button" }, "Discard them")
  discard.addEventListener("click", () => panel.send({ choose: { draft: "discard" } }))
  waits.append(words, discard)
  fields.append(
    element("div", { class: "called" }, element("label", { for: "bearing-name" }, "Name"), called),
    panel.choice("kind"), panel.choice("numbers"), waits)
  for (const group of spec.groups) {
    const box = element("fieldset", { "data-group": group.title }, element("legend", {}, group.title))
    box.append(...group.controls.map(panel.control))
    for (const name of Object.keys(spec.choices))
      if (spec.choices[name].group === group.title) box.append(panel.choice(name))
    fields.append(box)
  }
  const facts = element("dl", { class: "facts", "aria-label": "What follows from the dimensions" })
  const note = element("p", { class: "origin" })
  const side = element("div", { class: "side" }, drawing.picture, about, facts, note)

  const take = (state) => {
    panel.take(state)
    if (state.bearing) {
      const { name, own, note: origin } = state.bearing
      note.textContent = origin
      called.placeholder = name
      if (called.getRootNode().activeElement !== called) called.value = own
    }
    if (state.bearing) {
      const { element: one } = state.bearing
      for (const { root, label } of Object.values(panel.rows))
        root.querySelector("label").textContent = label.replace(/\bballs\b/, `${one}s`)
          .replace(/^Ball\b/, one[0].toUpperCase() + one.slice(1))
    }
    if (state.draft) {
      waits.hidden = !state.draft.words
      words.textContent = state.draft.words
    }
    for (const box of fields.querySelectorAll("fieldset"))
      box.hidden = [...box.querySelectorAll(".control")].every((row) => row.hidden)
  }
  let numbers = ""
  const show = () => {
    const { shape: now, facts: list } = model.shown
    if (!now) return
    if (JSON.stringify(now) !== numbers) {
      numbers = JSON.stringify(now)
      drawing.draw(now)
    }
    facts.replaceChildren(...list.map(({ label, symbol, value, about: sentence }) => {
      const name = element("dt", { title: sentence }, label, " ")
      name.append(element("i", { class: "symbol", html: symbol }))
      return element("div", {}, name, element("dd", {}, value))
    }))
  }
  take(model.state)
  panel.listen(take)
  show()
  touched("ball_diameter_mm")
  model.on("shown", show)
  return element("div", { class: "editor" }, fields, side)
}
