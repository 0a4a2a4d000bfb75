// Something that takes a while: what it needs to know, begin, cancel, how far it is.
export function render({ model }) {
  const inputs = {}
  // Options of a list, those with the same third part under it as their heading.
  const grouped = (options) => {
    const parts = []
    for (const [value, words, heading] of options) {
      const option = element("option", { value }, words)
      if (!heading) parts.push(option)
      else if (parts.at(-1)?.label === heading) parts.at(-1).append(option)
      else parts.push(element("optgroup", { label: heading }, option))
    }
    return parts
  }
  const field = ({ name, label, options, only }) => {
    const id = `job-${name}`
    const input = inputs[name] = options
      ? element("select", { id }, ...grouped(options))
      : element("input", { id, type: "text", inputmode: "decimal", autocomplete: "off" })
    input.value = model.values[name] ?? ""
    input.addEventListener("change", () => {
      fill(name)
      put_aside()
      if (model.spec.at_once) ask()
    })
    const root = element("div", { class: `field field-${name}` }, element("label", { for: id }, label), input)
    if (only) bound.push([root, only])
    return root
  }
  // Fields that mean something only with certain choices in others.
  const bound = []
  const put_aside = () => {
    for (const [root, only] of bound)
      root.hidden = !Object.entries(only).every(([other, values]) => values.includes(inputs[other].value))
  }
  // What is chosen in one field may bring the numbers of others with it.
  const fill = (name) => {
    const others = model.fills[name]?.[inputs[name].value] ?? {}
    for (const [other, value] of Object.entries(others)) inputs[other].value = value
  }
  const start = element("button", { type: "submit", class: "start" }, model.spec.start)
  const cancel = element("button", { type: "button", class: "cancel" }, "Cancel")
  const fields = element("div", { class: "fields" }, ...model.spec.fields.map(field))
  const filled = element("i")
  const bar = element("div", {
    class: "bar", role: "progressbar", "aria-label": model.spec.start,
    "aria-valuemin": "0", "aria-valuemax": "100",
  }, filled)
  const words = element("p", { class: "words", role: "status" })
  const going = element("div", { class: "going" }, bar, words)
  // Where fields start the job, the button is seldom needed and stands out of their way.
  if (model.spec.at_once) going.prepend(start, cancel)
  else fields.append(start, cancel)
  const form = element("form", {}, fields, going)

  const ask = () => {
    const given = Object.entries(inputs).map(([name, input]) => [name, input.value])
    model.send_msg({ start: Object.fromEntries(given) })
  }
  form.addEventListener("submit", (event) => {
    event.preventDefault()
    ask()
  })
  cancel.addEventListener("click", () => model.send_msg({ cancel: true }))

  const show = () => {
    const { mood, part, words: said } = model.state
    const running = mood == "waiting" || mood == "busy"
    form.dataset.mood = mood
    cancel.disabled = !running
    bar.hidden = !running
    bar.setAttribute("aria-valuenow", String(Math.round(100*part)))
    filled.style.width = `${100*part}%`
    if (words.textContent !== said) words.textContent = said
  }
  model.on("state", show)
  model.on("values", () => {
    for (const [name, value] of Object.entries(model.values)) inputs[name].value = value
    put_aside()
  })
  show()
  put_aside()
  return form
}
