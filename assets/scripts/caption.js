// Head of a view: title, a line about it and the rest behind "?", and a menu that exports the figure:
// pictures, numbers, Python; the numbers as a table to read, too. Enlarging it is in enlarge.js.

export function render({ model }) {
  const root = markup(CAPTION, {
    png: async () => save_file(file("png"), await figures_as_png(views(), about())),
    svg: () => save_file(file("svg"), drawing_of_all(views(), about()).text, "image/svg+xml"),
    "copy-picture": async () => {
      const done = await copy_image(figures_as_png(views(), about()))
      announce("said", done ? "The picture is copied." : "This browser does not copy pictures; save it as PNG.")
    },
    csv: () => model.send_msg("csv"),
    table: () => model.send_msg("table"),
    python: () => model.send_msg("python"),
    copy: async () => {
      const done = await copy_text(code.textContent)
      if (!done) getSelection().selectAllChildren(code)
      part("copied").textContent = done ? "Copied." : "Selected: copy it with the keyboard."
    },
    save: () => save_file(file("py"), code.textContent, "text/x-python"),
  })
  const part = (id) => root.querySelector(`#${id}`)
  const { title } = model, head = root.querySelector("h2"), code = part("code"), menu = part("exports")
  const lead = model.leads_to && button("", () => announce("show", model.leads_to), { class: "lead", title: "Open its tab" })
  if (lead) head.append(lead)
  follow(model, ["title"], () => {
    (lead || head).textContent = model.lead ? `${model.title}: ${model.lead}` : model.title
  })
  if (model.compact) {  // the figure says it itself; the rest is a tooltip
    follow(model, ["line", "rest"], () => { head.title = `${model.rest} ${model.line}`.trim() })
    root.className = "compact"
    root.replaceChildren(head)
    return root
  }
  root.addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key]
    if (!step || !menu.matches(":popover-open")) return
    event.preventDefault()
    const all = [...menu.querySelectorAll("button:not([hidden])")], at = all.indexOf(root.getRootNode().activeElement)
    all.at((Math.max(at, step < 0 ? 0 : -1) + step) % all.length).focus()
  })
  unfolds(part("more"), part("rest"))
  follow(model, ["line", "rest"], () => {
    part("line").textContent = model.line
    part("rest").innerHTML = model.rest
    part("more").hidden = !model.rest
  })
  for (const [id, label] of [["more", "More about"], ["opener", "Export"], ["exports", "Export"],
                             ["lines", "Python for"], ["reading", "Numbers of"], ["rows", "Numbers of"]])
    part(id).setAttribute("aria-label", `${label} “${title}”`)
  part("lines").querySelector("strong").append(`${title} in Python`)
  part("reading").querySelector("strong").append(title)

  // with the scene, "bearing-load-fan-rig-defect-12.9deg-50-um-load-100-N.png", or with the file that was measured
  const file = (ending) => {
    const scene = (model.subject.replace(/\.[a-z]\w{1,4}$/i, "") || (document.documentElement.dataset.scene ?? "")).replaceAll("°", "deg").replaceAll("µ", "u")
      .replace(/[^\p{L}\p{N}.]+/gu, "-").slice(0, 90)
    const name = `bearing-${model.name_of_files}`.replace(/^bearing-(?=bearing)/, "")
    return `${name}${scene && `-${scene}`.replace(/-$/, "")}.${ending}`
  }
  // Bokeh's figures, or the drawing that the view has instead.
  const views = () => model.picture
    ? [drawing_of([...inside(root.getRootNode().host.getRootNode())].find((one) => one.matches("svg.picture")))]
    : figures_on_screen(model.figures)
  // What a picture says of itself: its title, its key, the scene and the link to it.
  const about = () => {
    const { scene, link } = document.documentElement.dataset
    const of = model.subject ? { scene: model.subject } : { scene, link }
    return { title, key: model.line, ...of }
  }
  // before a button acts: a dialog that it opens is then the last to take the focus
  menu.addEventListener("click", () => menu.hidePopover(), true)
  menu.addEventListener("toggle", ({ newState }) => {
    if (newState === "open") menu.querySelector("button:not([hidden])").focus()
  })
  model.on("msg:custom", ({ csv, python: lines, table, count }) => {
    if (csv) save_file(file("csv"), csv, "text/csv")
    if (table !== undefined) {
      part("count").textContent = count
      part("rows").innerHTML = table
      part("reading").showModal()
      part("rows").focus()
    }
    if (lines === undefined) return
    code.textContent = lines || "Nothing is drawn yet."
    part("copied").textContent = ""
    part("lines").showModal()
    part("copy").focus()
  })

  const enlarge = enlarging(model, root)
  follow(model, ["empty", "nothing", "figures"], () => {
    const drawn = model.figures.length > 0 || model.picture
    for (const one of root.querySelectorAll(".drawn")) one.hidden = !drawn
    for (const one of root.querySelectorAll(".numbers")) one.hidden = model.empty
    part("opener").hidden = model.nothing && !drawn
    enlarge.hidden = !model.figures.length
  })
  return root
}
