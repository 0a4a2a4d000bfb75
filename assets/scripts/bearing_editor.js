// The bearing: every dimension, and a picture that shows what each one is. rows.js is put in front
// of this file; the picture is SVG made by the server, with a group for each dimension.

const DRAWN_WITH = { youngs_modulus_gpa: "load_deflection_factor", poisson: "load_deflection_factor",
  ball_youngs_modulus_gpa: "load_deflection_factor", ball_poisson: "load_deflection_factor" }

export function render({ model }) {
  const about = element("p", { class: "about", "aria-hidden": "true" })
  let last = "", one = "ball"
  // What is said of balls, with the rolling elements of this kind.
  const named = (text) => text.replace(/\bball/g, one).replace(/\bBall/g, one[0].toUpperCase() + one.slice(1))
  const touched = (name) => {
    if (name === last) return
    last = name
    mark()
    describe()
  }
  const describe = () => {
    const { label, symbol, about: sentence } = panel.rows[last]
    about.innerHTML = `<strong>${named(label)} <i class="symbol">${symbol}</i></strong> `
    about.append(named(sentence))
  }
  const panel = make_rows(model, { touched })
  const picture = element("div", { class: "drawing" })
  picture.addEventListener("click", (event) => {
    const name = event.target.closest(".dimension")?.dataset.name, row = panel.rows[name]
    if (row && !row.root.hidden) row.number.focus()
    else if (row) touched(name)
  })
  const mark = () => {
    for (const group of picture.querySelectorAll(".dimension"))
      group.classList.toggle("marked", group.dataset.name === (DRAWN_WITH[last] ?? last))
  }

  const called = element("input", { type: "text", id: "bearing-name", maxlength: "60",
    autocomplete: "off", spellcheck: "false" })
  called.addEventListener("change", () => panel.send({ choose: { name: called.value } }))
  const boxes = model.spec.groups.map((group) => panel.group_box(group))
  const fields = panel.form({ class: "fields", "aria-label": "Dimensions of the bearing" },
    element("div", { class: "called" }, element("label", { for: "bearing-name" }, "Name"), called),
    panel.choice("kind"), panel.choice("numbers"), panel.choice("ball_material"), ...boxes)
  const facts = element("dl", { class: "facts", "aria-label": "What follows from the dimensions" })
  const note = element("p", { class: "origin" })

  const rename = (now) => {
    one = now
    for (const { root, label } of Object.values(panel.rows))
      root.querySelector("label").textContent = named(label)
    for (const box of boxes) box.firstChild.textContent = named(box.dataset.group)
    if (last) describe()
  }
  const take = (state) => {
    panel.take(state)
    if (state.bearing) {
      const { name, own, note: origin, element: now } = state.bearing
      if (now !== one) rename(now)
      note.textContent = origin
      called.placeholder = name
      if (called.getRootNode().activeElement !== called) called.value = own
    }
    for (const box of boxes)
      box.hidden = [...box.querySelectorAll(".control")].every((row) => row.hidden)
  }
  take(model.state)
  panel.listen(take)
  follow(model, ["picture"], () => {
    picture.innerHTML = model.picture
    mark()
  })
  follow(model, ["facts"], () => facts.replaceChildren(
    ...model.facts.map(({ label, symbol, value, about: sentence }) => element("div", {},
      element("dt", { title: sentence }, label, " ", element("i", { class: "symbol", html: symbol })),
      element("dd", {}, value)))))
  touched("ball_diameter_mm")
  return element("div", { class: "editor" }, fields, element("div", { class: "side" }, picture, about, facts, note))
}
