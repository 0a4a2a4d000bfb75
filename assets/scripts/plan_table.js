// Plans as a table, with remarks beneath.
export function render({ model }) {
  const box = document.createElement("div")
  const cell = (text, tag = "td") => {
    const made = document.createElement(tag)
    made.textContent = text
    return made
  }
  const write = () => {
    const { heads, rows, remarks, stale } = model.shown
    const table = document.createElement("table")
    const head = table.createTHead().insertRow()
    for (const title of heads) {
      const made = cell(title, "th")
      made.scope = "col"
      head.append(made)
    }
    const body = table.createTBody()
    for (const [first, ...others] of rows) {
      const row = body.insertRow()
      const made = cell(first, "th")
      made.scope = "row"
      row.append(made, ...others.map((text) => cell(text)))
    }
    const list = document.createElement("ul")
    list.append(...remarks.map((sentence) => {
      const item = document.createElement("li")
      item.textContent = sentence
      return item
    }))
    box.dataset.stale = String(stale)
    box.replaceChildren(table, list)
  }
  model.on("shown", write)
  write()
  return box
}
