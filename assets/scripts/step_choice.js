// Which steps motions are marched with: chosen from a list, or left to the program.
export function render({ model }) {
  const select = document.createElement("select")
  select.id = "step-choice"
  const label = document.createElement("label")
  label.htmlFor = select.id
  label.textContent = "Steps of the scene's motion"
  const reset = document.createElement("button")
  reset.type = "button"
  reset.className = "reset"
  reset.textContent = "Reset"
  const field = document.createElement("div")
  field.className = "field"
  field.append(label, select)
  const row = document.createElement("div")
  row.className = "fields"
  Object.assign(row.style, { fontFamily: "var(--font)", paddingBottom: "6px" })
  const words = document.createElement("p")
  words.className = "words"
  words.setAttribute("role", "status")
  row.append(field, reset, words)

  select.addEventListener("change", () => model.send_msg({ use: select.value }))
  reset.addEventListener("click", () => model.send_msg({ use: "" }))

  const show = () => {
    const options = model.options.map(([value, text]) => new Option(text, value))
    select.replaceChildren(new Option("automatic", ""), ...options)
    select.value = model.chosen
    reset.disabled = model.chosen === ""
    if (words.textContent !== model.words) words.textContent = model.words
  }
  for (const name of ["options", "chosen", "words"]) model.on(name, show)
  show()
  return row
}
