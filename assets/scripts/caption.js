// Head of a view: title, what it shows in a line and the rest behind "?", and a menu to take the figure
// along: pictures, numbers, Python; the numbers as a table to read, too.

const MOST_ROWS = 300  // of a table on the page; the file has all
const UNITS = [
  [/_n_m_per_rad$/, "N·m/rad"], [/_n_per_rad$/, "N/rad"], [/_n_per_m$/, "N/m"],
  [/_m_per_s2$/, "m/s²"], [/_deg$/, "°"], [/_um$/, "µm"], [/_mm$/, "mm"], [/_hz$/, "Hz"],
  [/_ms$/, "ms"], [/_db$/, "dB"], [/_n$/, "N"], [/_s$/, "s"], [/_m$/, "m"],
]

// "ball_load_n" is "ball load (N)"
function column_words(name) {
  const [ending, unit] = UNITS.find(([ending]) => ending.test(name)) ?? [null, ""]
  const words = (ending ? name.replace(ending, "") : name).replaceAll("_", " ")
  return unit ? `${words} (${unit})` : words
}

// Numbers to six digits, with a true minus sign; what is no number stays as it is.
function cell_words(text) {
  if (text.trim() === "" || !isFinite(Number(text))) return text === "nan" ? "no value" : text
  const [mantissa, exponent] = String(Number(Number(text).toPrecision(6))).split("e")
  const raised = exponent && [...exponent.replace("+", "")].map((digit) =>
    digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).join("")
  return mantissa.replace("-", "−") + (raised ? `·10${raised}` : "")
}

// Rows of comma-separated text; cells in quotes may hold commas and quotes.
const csv_rows = (text) => text.trimEnd().split("\n").map((line) =>
  [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)]
    .map(([, quoted, plain]) => quoted?.replaceAll('""', '"') ?? plain))

export function render({ model }) {
  const file = (ending) => `bearing-${model.name_of_files}.${ending}`
  const item = (name, words, act) => {
    const made = element("button", { type: "button", class: `save-${name}` }, words)
    made.addEventListener("click", act)
    return made
  }
  // Bokeh's figures, or the drawing that the view has instead.
  const views = () => model.picture
    ? [drawing_of(find_deep(opener.getRootNode().host.getRootNode(), "svg.picture"))]
    : figures_on_screen(model.figures)
  const failed = (error) => console.warn("the figure could not be saved", error)
  const pictures = [
    item("png", "Picture (PNG)", () =>
      figures_as_png(views()).then((blob) => save_file(file("png"), blob), failed)),
    item("svg", "Drawing (SVG)", () =>
      save_file(file("svg"), figures_as_svg(views(), model.title), "image/svg+xml")),
  ]
  const drawn = () => model.figures.length > 0 || model.picture
  const offer = () => { for (const one of pictures) one.hidden = !drawn() }
  model.on("figures", offer)
  offer()
  let wanted = "file"
  const ask = (what) => {
    wanted = what
    model.send_msg("csv")
  }
  const numbers = item("csv", "Numbers (CSV)", () => ask("file"))
  const table = item("table", "Numbers as a table", () => ask("table"))
  const has_numbers = () => { for (const one of [numbers, table]) one.hidden = model.empty }
  model.on("empty", has_numbers)
  has_numbers()
  const python = item("python", "Lines of Python", () => model.send_msg("python"))

  // The lines, to be copied or saved
  const code = element("pre", { tabindex: "0", "aria-label": "Lines of Python" })
  const said = element("span", { "aria-live": "polite" })
  const copy = element("button", { type: "button" }, "Copy")
  copy.addEventListener("click", async () => {
    if (await copy_text(code.textContent)) said.textContent = "Copied."
    else {
      getSelection().selectAllChildren(code)
      said.textContent = "Marked: copy by hand."
    }
  })
  const save = element("button", { type: "button" }, "Save")
  save.addEventListener("click", () => save_file(file("py"), code.textContent, "text/x-python"))
  const close = element("button", { type: "button", class: "close", "aria-label": "Close" }, "\u00d7")
  const dialog = element("dialog", { "aria-label": `Python for “${model.title}”` },
    element("div", { class: "bar" }, element("strong", {}, `${model.title} in Python`), said, copy, save, close), code)
  close.addEventListener("click", () => dialog.close())
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close() })

  // The numbers, to be read
  const rows = element("div", { class: "rows", tabindex: "0", role: "region",
                             "aria-label": `Numbers of “${model.title}”` })
  const how_many = element("span", { "aria-live": "polite" })
  const close_table = element("button", { type: "button", class: "close", "aria-label": "Close" }, "\u00d7")
  const table_dialog = element("dialog", { "aria-label": `Numbers of “${model.title}”` },
    element("div", { class: "bar" }, element("strong", {}, model.title), how_many, close_table), rows)
  close_table.addEventListener("click", () => table_dialog.close())
  table_dialog.addEventListener("click", (event) => {
    if (event.target === table_dialog) table_dialog.close()
  })
  const show_table = (text) => {
    const [names, ...lines] = csv_rows(text)
    const line = (cells, tag, scope) => element("tr", {}, ...cells.map((cell) => element(tag, scope, cell)))
    const shown = lines.slice(0, MOST_ROWS)
    how_many.textContent = !text ? "Nothing is drawn yet."
      : lines.length > MOST_ROWS ? `Rows 1 to ${MOST_ROWS} of ${lines.length}; the CSV file has all.`
      : `${lines.length} ${lines.length === 1 ? "row" : "rows"}`
    rows.replaceChildren(...(text ? [element("table", {},
      element("thead", {}, line(names.map(column_words), "th", { scope: "col" })),
      element("tbody", {}, ...shown.map((cells) => line(cells.map(cell_words), "td"))))] : []))
    table_dialog.showModal()
    rows.focus()
  }

  model.on("msg:custom", (message) => {
    if (message.csv !== undefined && (wanted === "table" || !message.csv)) show_table(message.csv)
    else if (message.csv !== undefined) save_file(file("csv"), message.csv, "text/csv")
    if (message.python !== undefined) {
      code.textContent = message.python || "Nothing is drawn yet."
      said.textContent = ""
      dialog.showModal()
      copy.focus()
    }
  })
  const grey = element("p", { class: "grey" })
  const show_pinned = () => {
    grey.hidden = !model.pinned
    grey.textContent = `Grey is the pinned scene “${model.pinned}”.`
  }
  model.on("pinned", show_pinned)
  show_pinned()

  const line = element("p", { class: "line" })
  const rest = element("p", { class: "rest", id: "rest" })
  const write_words = () => {
    line.textContent = model.line
    rest.textContent = model.compact ? `${model.line} ${model.rest}` : model.rest
  }
  for (const name of ["line", "rest"]) model.on(name, write_words)
  write_words()
  const help = element("button", { type: "button", class: "help", "aria-controls": "rest",
                                   "aria-label": `More about “${model.title}”` }, "?")
  const explain = (shown) => {
    rest.hidden = !shown
    help.setAttribute("aria-expanded", String(shown))
  }
  help.addEventListener("click", () => explain(rest.hidden))
  help.hidden = !model.rest
  explain(false)
  const title = element("h2", {}, model.title)
  if (model.leads_to) {
    const lead = element("button", { type: "button", class: "lead", title: "Open it in full" }, model.title)
    lead.addEventListener("click", () =>
      window.dispatchEvent(new CustomEvent("explorer-show", { detail: model.leads_to })))
    title.replaceChildren(lead)
  }
  const head = element("div", { class: "title" }, title, help)
  if (model.compact) {  // all there is to say is behind the "?"
    help.hidden = false
    return element("header", { class: "compact" }, element("div", { class: "words" }, head, rest, grey))
  }
  const words = element("div", { class: "words" }, head, line, rest, grey)

  const opener = element("button", { type: "button", class: "opener", "aria-haspopup": "menu",
                                     "aria-label": `Export “${model.title}”` }, "Export")
  // where there is nothing yet, there is nothing to take along
  const has_anything = () => { opener.hidden = model.nothing && !drawn() }
  for (const name of ["nothing", "figures"]) model.on(name, has_anything)
  has_anything()
  const menu = menu_of([...pictures, numbers, table, python], { class: "menu", "aria-label": `Export “${model.title}”` })
  opens_below(opener, menu, 190)
  return element("header", {}, words, opener, menu, dialog, table_dialog)
}
