// Warnings: the first limit that is crossed in a line, and all limits on demand. Who listens to the
// page hears of all that are crossed.
export function render({ model }) {
  const strip = document.createElement("section")
  const warnings = document.createElement("div")
  const more = document.createElement("button")
  const list = document.createElement("div")
  strip.className = "strip"
  strip.setAttribute("aria-label", "Limits of the model")
  warnings.className = "warnings"
  warnings.setAttribute("role", "status")
  more.type = "button"
  more.setAttribute("aria-expanded", "false")
  more.setAttribute("aria-controls", "limits-list")
  list.id = "limits-list"
  list.className = "list"
  list.hidden = true
  strip.append(warnings, more, list)

  const cell = (text, tag = "td") => {
    const made = document.createElement(tag)
    made.textContent = text
    return made
  }
  const words = { crossed: "crossed", kept: "kept", unknown: "not known" }
  const fill = () => {
    const table = document.createElement("table")
    const head = table.createTHead().insertRow()
    for (const title of ["Looked at", "Value", "Limit", "", "In words"]) head.append(cell(title, "th"))
    const body = table.createTBody()
    for (const { name, value, limit, state, sentence } of model.rows) {
      const row = body.insertRow()
      row.dataset.state = state
      row.append(cell(name), cell(value), cell(limit), cell(words[state]), cell(sentence))
    }
    list.replaceChildren(table)
  }
  let said = null
  const write = () => {
    const crossed = model.rows.filter(({ state }) => state === "crossed")
    const text = crossed.map(({ sentence }) => sentence).join("\n")
    if (text !== said) {
      said = text
      warnings.replaceChildren(...crossed.map(({ sentence }) => {
        const line = document.createElement("p")
        line.textContent = line.title = sentence
        return line
      }))
    }
    strip.dataset.crossed = String(crossed.length)
    // beside the status line where all is well, a line of its own where it is not
    strip.getRootNode().host?.closest("footer")?.toggleAttribute("data-crossed", crossed.length > 0)
    // where there is little room, the first of it: how many are crossed, or kept
    const [first, ...others] = model.summary.split(", ")
    const [count, word, ...how] = first.split(" ")
    more.replaceChildren(`${count} `, element("span", { class: "word" }, `${word} `), how.join(" "), element("span", { class: "rest" }, others.length ? `, ${others.join(", ")}` : ""),
      element("span", { class: "help", "aria-hidden": "true" }, "?"))
    more.setAttribute("aria-label", model.summary)
    more.title = list.hidden ? "Show all limits of the model" : "Hide the limits"
    if (!list.hidden) fill()
  }
  more.addEventListener("click", () => {
    list.hidden = !list.hidden
    more.setAttribute("aria-expanded", String(!list.hidden))
    write()
  })
  strip.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !list.hidden) {
      more.click()
      more.focus()
    }
  })
  model.on("rows", write)
  model.on("summary", write)
  requestAnimationFrame(write)  // when it stands on the page
  return strip
}
