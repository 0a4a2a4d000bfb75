// Masses, support and contact law. rows.js is put in front of this file.
export function render({ model }) {
  const panel = make_rows(model)
  const form = panel.form({ class: "groups", "aria-label": "Rotor, housing and support" },
    ...model.spec.groups.map((group) => panel.group_box(group)))
  for (const { number } of Object.values(panel.rows)) number.placeholder = "not known"
  const damping = panel.rows.contact_damping
  damping.extra.append(button("auto", () => panel.send({ typed: { contact_damping: "" } }),
    { class: "reset", title: "From the stiffness of the healthy bearing" }))
  follow(model, ["automatic"], () => { damping.number.placeholder = model.automatic })
  panel.take(model.state)
  panel.listen()
  return form
}
