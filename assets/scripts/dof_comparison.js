// Free directions: as the scene needs, or forced. rows.js is put in front of this file.

export function render({ model }) {
  const panel = make_rows(model)
  let forced = null  // names of the directions forced, or null
  const refusal = element("p", { class: "refusal", role: "alert", hidden: "" })
  const boxes = {}
  const active = () => (forced ?? model.shown.active ?? "").split(" ").filter(Boolean)
  const automatic = element("button", { type: "button", class: "reset auto", "aria-pressed": "true" },
    "As the scene needs")
  automatic.addEventListener("click", () => panel.send({ choose: { dofs: "auto" } }))
  const group = element("fieldset", { class: "boxes" }, element("legend", {}, "Free directions"), automatic)
  for (const [name, words] of model.spec.dofs) {
    const box = element("input", { type: "checkbox", id: `dof-${name}` })
    boxes[name] = box
    box.addEventListener("change", () => {
      const wanted = model.spec.dofs.map(([one]) => one).filter((one) => boxes[one].checked)
      panel.send({ choose: { dofs: wanted.join(" ") } })
    })
    group.append(element("label", { for: `dof-${name}` }, box, words))
  }
  const head = element("h3", {}, "")
  const facts = element("dl", { class: "facts" })
  const show = () => {
    const free = active()
    for (const [name, box] of Object.entries(boxes)) box.checked = free.includes(name)
    automatic.setAttribute("aria-pressed", String(forced === null))
    const { needed = "", facts: list = [], against = "" } = model.shown
    automatic.title = needed ? `This scene needs ${needed}` : ""
    head.textContent = list.length ? `Greatest difference against ${against}` : "Nothing is left out"
    facts.replaceChildren(...list.map(({ label, symbol, value }) => element("div", {},
      element("dt", {}, label, " ", element("i", { class: "symbol", html: symbol })),
      element("dd", {}, value))))
  }
  const take = (state) => {
    if (state.choices?.dofs === undefined) return
    forced = state.choices.dofs === "auto" ? null : state.choices.dofs
    refusal.hidden = true
    show()
  }
  take(model.state)
  panel.listen(take)
  model.on("msg:custom", ({ refused }) => {
    if (!refused?.dofs) return
    refusal.textContent = refused.dofs
    refusal.hidden = false
  })
  model.on("shown", show)
  show()
  return element("div", { class: "dofs" }, element("form", {}, group, refusal),
    element("div", {}, head, facts))
}
