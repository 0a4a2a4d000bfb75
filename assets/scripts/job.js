// Something that takes a while: what it needs to know, begin, cancel, how far it is.
const MANY = 20  // options from which on a list can be searched

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
    const search = options?.length > MANY ? search_in(input, options, label) : null
    input.addEventListener("change", () => {
      fill(name)
      put_aside()
      if (model.spec.at_once) ask()
    })
    const root = element("div", { class: `field field-${name}` },
      element("label", { for: id }, label), ...(search ? [search] : []), input)
    if (only) bound.push([root, only])
    return root
  }
  // Above a long list a field that leaves only what holds all its words; what is chosen stays.
  const search_in = (select, options, label) => {
    const search = element("input", { type: "search", class: "search", autocomplete: "off",
      placeholder: `Search ${options.length}`, "aria-label": `Search: ${label}` })
    search.addEventListener("input", () => {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
      const chosen = select.value
      const kept = options.filter(([value, text, heading = ""]) => value === chosen
        || words.every((word) => `${text} ${heading}`.toLowerCase().includes(word)))
      select.replaceChildren(...grouped(kept))
      select.value = chosen
      select.size = words.length ? Math.min(Math.max(kept.length, 2), 10) : 0
    })
    search.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && search.value) {
        search.value = ""
        search.dispatchEvent(new Event("input"))
      }
      if (event.key !== "Enter" && event.key !== "ArrowDown") return
      event.preventDefault()  // into the list, at the first that was found
      const first = [...select.options].find((option) => option.value !== select.value)
      select.focus()
      if (event.key === "Enter" && first && search.value) {
        select.value = first.value
        select.dispatchEvent(new Event("change"))
      }
    })
    select.addEventListener("change", () => {
      if (!search.value) return
      search.value = ""
      search.dispatchEvent(new Event("input"))
    })
    return search
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
