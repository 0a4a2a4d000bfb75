// The first lines of a file. What is chosen over a column goes to the server, which answers with the
// roles and units of all: a role that only one column can have leaves the one that had it. Of many
// columns the first are shown, those with a role, and those that are called for.
const FIRST = 24
export function render({ model }) {
  const caption = element("p"), table = element("table")
  const root = element("div", { class: "columns", role: "region", tabindex: "0", "aria-label": "First lines of the file" }, caption, table)
  let file = "", made = "", called = []
  let lists = []  // [number of the column, lists of roles, of units]
  const list = (pairs, label, act) => {
    const part = element("select", { "aria-label": label }, ...pairs.map(([value, words]) => element("option", { value }, words)))
    part.addEventListener("change", () => act(part.value))
    return part
  }
  const make = (there) => {
    const { names, places, lines, rows } = model.shown
    lists = there.map((column) => {
      const send = () => model.send_msg({ column, role: role.value, unit: unit.value })
      const role = list(model.roles, `Column ${column + 1}, ${names[column]}, is`, send)
      const unit = list(model.units, `Unit of the signal, ${names[column]}`, send)
      return [column, role, unit]
    })
    const heads = there.map((column) =>
      element("th", { scope: "col" }, names[column], ...(places[column] ? [element("small", {}, places[column])] : [])))
    const cells = (line) => there.map((column) => element("td", {}, line[column]))
    table.replaceChildren(
      element("thead", {}, element("tr", {}, ...lists.map(([, ...both]) => element("td", {}, ...both))), element("tr", {}, ...heads)),
      element("tbody", {}, ...lines.map((line) => element("tr", {}, ...cells(line)))))
    const rest = [...names.entries()].filter(([column]) => !there.includes(column))
    caption.replaceChildren(`The first ${lines.length} of ${rows.toLocaleString("en")} lines. Say above each column what it is.`)
    if (rest.length) caption.append(` ${there.length} of ${names.length} columns are shown: `,
      list([["", "show another"], ...rest], "Show another column", (column) => { called.push(+column); write() }))
  }
  const write = () => {
    const { roles, units, marks, names, lines } = model.shown
    if (!names) return
    if (file !== (file = JSON.stringify([names, lines, model.units]))) made = ""
    const there = [...names.keys()].filter((column) => column < FIRST || roles[column] || called.includes(column))
    if (made !== (made = String(there))) make(there)
    root.className = `columns ${marks.columns}`
    for (const [column, role, unit] of lists) {
      role.value = roles[column]
      role.classList.toggle("used", roles[column] !== "")
      unit.value = units[column]
      unit.className = marks.unit
      unit.hidden = !model.signals.includes(roles[column])
    }
  }
  follow(model, ["shown", "units"], write)
  return root
}
