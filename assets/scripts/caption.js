// Head of a view: title, a line about it and the rest behind "?", and a menu that exports the figure:
// pictures, numbers, Python; the numbers as a table to read, too. Enlarging it is in enlarge.js.

const MOST_ROWS = 300  // of a table on the page; the file has all
const PLACE = /angle|frequency|time/  // columns that say where a row is
const UNITS = { n_m_per_rad: "N·m/rad", n_per_rad: "N/rad", n_per_m: "N/m", m_per_s2: "m/s²", deg: "°",
                um: "µm", mm: "mm", hz: "Hz", ms: "ms", db: "dB", n: "N", s: "s", m: "m" }
const WITH_UNIT = new RegExp(`^(.+)_(${Object.keys(UNITS).join("|")})$`)

// "ball_load_n" is "ball load (N)"
function column_words(name) {
  const [, bare = name, unit] = WITH_UNIT.exec(name) ?? []
  return bare.replaceAll("_", " ") + (unit ? ` (${UNITS[unit]})` : "")
}

// Numbers to six digits, with a true minus sign; what is no number stays as it is.
function cell_words(text) {
  if (text.trim() === "" || !isFinite(Number(text))) return text === "nan" ? "no value" : text
  const [mantissa, exponent] = String(Number(Number(text).toPrecision(6))).replace("e+", "e").split("e")
  const raised = exponent?.replace(/./g, (sign) => sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign])
  return mantissa.replace("-", "−") + (raised ? `·10${raised}` : "")
}

// Rows of comma-separated text; cells in quotes may hold commas and quotes.
const csv_rows = (text) => text.trimEnd().split("\n").map((line) =>
  [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)]
    .map(([, quoted, plain]) => quoted?.replaceAll('""', '"') ?? plain))

export function render({ model }) {
  const title = element("h2", {}, model.leads_to
    ? button(model.title, () => announce("show", model.leads_to), { class: "lead", title: "Open its tab" })
    : model.title)
  const help = element("button", { type: "button", class: "help", "aria-controls": "rest",
                                   "aria-label": `More about “${model.title}”` }, "?")
  const line = element("p", { class: "line" })
  const rest = element("p", { class: "rest", id: "rest" })
  unfolds(help, rest)
  help.hidden = !model.rest
  follow(model, ["line", "rest"], () => {
    line.textContent = model.line
    rest.textContent = model.rest
    if (model.compact) title.title = `${model.line} ${model.rest}`.trim()
  })
  if (model.compact)  // the figure says it itself; the rest is a tooltip
    return element("header", { class: "compact" }, element("div", { class: "words" }, title))
  const head = element("div", { class: "title" }, title, help)

  const file = (ending) => `bearing-${model.name_of_files}.${ending}`
  const item = (name, words, act) => button(words, act, { class: `save-${name}` })
  // Bokeh's figures, or the drawing that the view has instead.
  const views = () => model.picture
    ? [drawing_of(find_deep(opener.getRootNode().host.getRootNode(), "svg.picture"))]
    : figures_on_screen(model.figures)
  // What a picture says of itself: its title, its key, the scene and the link to it.
  const about = () => {
    const { scene, link } = document.documentElement.dataset
    return { title: model.title, key: model.line, scene, link }
  }
  const as_png = () => figures_as_png(views(), about())
  const copy_picture = async () => {
    const done = await copy_image(as_png())
    announce("said", done ? "The picture is copied." : "This browser does not copy pictures; save it as PNG.")
  }
  const pictures = [
    item("png", "Picture (PNG)", async () => save_file(file("png"), await as_png())),
    item("svg", "Drawing (SVG)", () => save_file(file("svg"), figures_as_svg(views(), about()), "image/svg+xml")),
    item("copy", "Copy picture", copy_picture),
  ]
  let wanted = "file"
  const ask_for = (what) => () => {
    wanted = what
    model.send_msg("csv")
  }
  const numbers = [item("csv", "Numbers (CSV)", ask_for("file")),
                   item("table", "Numbers as a table", ask_for("table"))]
  const python = item("python", "Lines of Python", () => model.send_msg("python"))

  // The lines, to be copied or saved
  const code = element("pre", { tabindex: "0", "aria-label": "Lines of Python" })
  const copied = element("span", { "aria-live": "polite" })
  const copy = button("Copy", async () => {
    const done = await copy_text(code.textContent)
    if (!done) getSelection().selectAllChildren(code)
    copied.textContent = done ? "Copied." : "Selected: copy it with the keyboard."
  })
  const save = button("Save", () => save_file(file("py"), code.textContent, "text/x-python"))
  const dialog = dialog_of(`Python for “${model.title}”`, `${model.title} in Python`, [copied, copy, save], code)

  // The numbers, to be read
  const rows = element("div", { class: "rows", tabindex: "0", role: "region", "aria-label": `Numbers of “${model.title}”` })
  const count = element("span", { "aria-live": "polite" })
  const table = dialog_of(`Numbers of “${model.title}”`, model.title, [count], rows)
  const show_table = (text) => {
    const [names, ...lines] = csv_rows(text)
    const cells = (texts, tag) => element("tr", {}, ...texts.map((cell) => element(tag, {}, cell)))
    // what is zero up to somewhere begins there
    const says = (cells) => cells.some((cell, i) => !PLACE.test(names[i]) && Number(cell) !== 0 && cell !== "nan")
    const first = Math.max(0, lines.findIndex(says) - 1), shown = lines.slice(first, first + MOST_ROWS)
    count.textContent = !text ? "Nothing is drawn yet."
      : shown.length < lines.length ? `Rows ${first + 1} to ${first + shown.length} of ${lines.length}`
        + `${first ? "; before them all values are zero" : ""}; the CSV file has all.`
      : `${lines.length} ${lines.length === 1 ? "row" : "rows"}`
    rows.replaceChildren(...(text ? [element("table", {}, element("thead", {}, cells(names.map(column_words), "th")),
      element("tbody", {}, ...shown.map((line) => cells(line.map(cell_words), "td"))))] : []))
    table.showModal()
    rows.focus()
  }
  model.on("msg:custom", ({ csv, python: lines }) => {
    if (csv && wanted === "file") save_file(file("csv"), csv, "text/csv")
    else if (csv !== undefined) show_table(csv)
    if (lines === undefined) return
    code.textContent = lines || "Nothing is drawn yet."
    copied.textContent = ""
    dialog.showModal()
    copy.focus()
  })

  const { enlarge, steps } = enlarging(model)

  const opener = element("button", { type: "button", class: "opener", "aria-haspopup": "menu",
                                     "aria-label": `Export “${model.title}”` }, "Export")
  follow(model, ["empty", "nothing", "figures"], () => {
    const drawn = model.figures.length > 0 || model.picture
    for (const one of pictures) one.hidden = !drawn
    for (const one of numbers) one.hidden = model.empty
    opener.hidden = model.nothing && !drawn
    enlarge.hidden = !model.figures.length
  })
  const menu = menu_of([...pictures, ...numbers, python], { class: "menu", "aria-label": `Export “${model.title}”` })
  opens_below(opener, menu, 190)
  return element("header", {}, element("div", { class: "words" }, head, line, rest), steps, enlarge, opener, menu, dialog, table)
}
