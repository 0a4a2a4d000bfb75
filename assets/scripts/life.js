// Life, pressure and film: what they are asked with, and what they say. element.js and rows.js are
// put in front of this file.

export function render({ model }) {
  const inputs = {}
  const form = element("form", { class: "asked", "aria-label": "Rating, oil and surfaces" })
  form.addEventListener("submit", (event) => event.preventDefault())
  for (const { name, label, unit, about } of model.spec.fields) {
    const id = `life-${name}`
    const number = element("input", { type: "text", inputmode: "decimal", autocomplete: "off",
      spellcheck: "false", class: "number", id, "aria-describedby": `${id}-refusal ${id}-about` })
    const refusal = element("p", { class: "refusal", role: "alert", id: `${id}-refusal`, hidden: "" })
    number.addEventListener("change", () => model.send_msg({ life: { [name]: number.value } }))
    inputs[name] = { number, refusal }
    form.append(element("div", { class: "control" },
      element("div", { class: "head" }, element("label", { for: id }, label),
        element("span", { class: "entry" }, number, element("span", { class: "unit" }, unit))),
      refusal, element("p", { class: "note", id: `${id}-about` }, about)))
  }
  inputs.dynamic_load_rating.number.placeholder = "ISO 281"
  inputs.viscosity.number.placeholder = "not given"
  const answers = element("div", { class: "answers" })
  const show = () => {
    const { groups = [], values = {} } = model.shown
    for (const [name, text] of Object.entries(values)) {
      const { number, refusal } = inputs[name]
      if (refusal.hidden && number.getRootNode().activeElement !== number) number.value = text
    }
    answers.replaceChildren(...groups.map(({ title, words, facts }) => {
      const list = element("dl", { class: "facts" })
      list.append(...facts.map(({ label, value, about }) => element("div", {},
        element("dt", { title: about, html: label }), element("dd", {}, value))))
      return element("section", {}, element("h3", {}, title), list, element("p", { class: "note" }, words))
    }))
  }
  model.on("msg:custom", ({ life }) => {
    if (!life) return
    for (const [name, { number, refusal }] of Object.entries(inputs)) {
      const sentence = life.refused[name]
      refusal.textContent = sentence ?? ""
      refusal.hidden = !sentence
      number.setAttribute("aria-invalid", sentence ? "true" : "false")
    }
  })
  model.on("shown", show)
  show()
  return element("div", { class: "life" }, form, answers)
}
