// How a figure shall look: one of several, some of several, or a number.
export function render({ model }) {
  const prefix = `look-${model.spec.name}`
  const shows = []
  const send = (name, value) => model.send_msg({ look: { [name]: value } })

  const one = ({ name, label, options }) => {
    const group = element("div", { class: "segments", role: "radiogroup", "aria-label": label })
    const radios = options.map(([value, words]) => {
      const id = `${prefix}-${name}-${value}`
      const radio = element("input", { type: "radio", id, name: `${prefix}-${name}`, value })
      radio.addEventListener("change", () => send(name, value))
      group.append(radio, element("label", { for: id }, words))
      return radio
    })
    shows.push(() => radios.forEach((radio) => {
      radio.checked = radio.value === model.values[name]
      radio.disabled = (model.disabled[name] ?? []).includes(radio.value)
    }))
    return element("div", { class: "field" }, element("span", { class: "label" }, label), group)
  }
  const some = ({ name, label, options }) => {
    const boxes = options.map(([value, , color]) => {
      const box = element("input", { type: "checkbox", id: `${prefix}-${name}-${value}`, value })
      box.style.accentColor = color
      box.addEventListener("change", () =>
        send(name, boxes.filter((other) => other.checked).map((other) => other.value)))
      return box
    })
    const marks = options.map(([value, words, color], index) => {
      const swatch = element("i", { class: "swatch" })
      swatch.style.background = color
      return element("label", { for: boxes[index].id }, boxes[index], swatch, words)
    })
    shows.push(() => boxes.forEach((box) => { box.checked = model.values[name].includes(box.value) }))
    return element("div", { class: "field checks", role: "group", "aria-label": label },
      element("span", { class: "label" }, label), ...marks)
  }
  const number = ({ name, label, hint }) => {
    const id = `${prefix}-${name}`
    const input = element("input", { type: "text", id, inputmode: "decimal", autocomplete: "off", placeholder: hint })
    input.addEventListener("change", () => send(name, input.value))
    shows.push(() => {
      input.value = model.values[name]
      input.placeholder = model.hints[name] ?? hint
    })
    return element("div", { class: "field" }, element("label", { for: id, class: "label" }, label), input)
  }

  const kinds = { one, some, number }
  const refusal = element("p", { class: "refusal", role: "alert" })
  const root = element("form", {}, ...model.spec.fields.map((field) => kinds[field.kind](field)), refusal)
  root.addEventListener("submit", (event) => event.preventDefault())
  const show = () => {
    for (const each of shows) each()
    refusal.textContent = model.refused
  }
  for (const name of ["values", "disabled", "hints", "refused"]) model.on(name, show)
  show()
  return root
}
