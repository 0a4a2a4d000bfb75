// The first lines of a file. What is chosen over a column goes to the server, which answers with the
// roles of all: a role that only one column can have leaves the one that had it.
export function render({ model }) {
  const head = element("tr"), named = element("tr"), body = element("tbody")
  const caption = element("p")
  const table = element("table", {}, element("thead", {}, head, named), body)
  const root = element("div", { class: "columns", role: "region", tabindex: "0", "aria-label": "First lines of the file" }, caption, table)
  let names = ""
  const make = () => {
    const { names: all, places, lines, rows } = model.shown
    head.replaceChildren(...all.map((name, column) => {
      const list = element("select", { "aria-label": `Column ${column + 1}, ${name}, is` },
        ...model.roles.map(([value, words]) => element("option", { value }, words)))
      list.addEventListener("change", () => model.send_msg({ column, role: list.value }))
      return element("td", {}, list)
    }))
    named.replaceChildren(...all.map((name, column) =>
      element("th", { scope: "col" }, name, ...(places[column] ? [element("small", {}, places[column])] : []))))
    body.replaceChildren(...lines.map((line) => element("tr", {}, ...line.map((cell) => element("td", {}, cell)))))
    caption.textContent = `The first ${lines.length} of ${rows.toLocaleString("en")} lines. Say above each column what it is.`
  }
  follow(model, ["shown"], () => {
    const { roles, mark, names: all, lines } = model.shown
    if (!all) return
    if (names !== (names = JSON.stringify([all, lines]))) make()
    root.className = `columns ${mark}`
    roles.forEach((role, column) => {
      const list = head.children[column]?.firstElementChild
      if (!list) return
      list.value = role
      list.classList.toggle("used", role !== "")
    })
  })
  return root
}
