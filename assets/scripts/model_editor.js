// Masses, support and contact law. rows.js is put in front of this file.

export function render({ model }) {
  const spec = model.spec
  const panel = make_rows(model)
  const form = element("form", { class: "groups", "aria-label": "Rotor, housing and support" })
  form.addEventListener("submit", (event) => event.preventDefault())
  for (const group of spec.groups) {
    const box = element("fieldset", {}, element("legend", {}, group.title))
    box.append(...group.controls.map(panel.control))
    for (const name of Object.keys(spec.choices))
      if (spec.choices[name].group === group.title) box.append(panel.choice(name))
    form.append(box)
  }
  const damping = panel.rows.contact_damping
  const automatic = element("button", { type: "button", class: "reset", title: "From the stiffness of the healthy bearing" }, "auto")
  automatic.addEventListener("click", () => panel.send({ typed: { contact_damping: "" } }))
  damping.extra.append(automatic)
  const show = () => { damping.number.placeholder = model.automatic }
  for (const { number } of Object.values(panel.rows)) number.placeholder = "not known"
  show()
  model.on("automatic", show)
  panel.take(model.state)
  panel.listen()
  return form
}
