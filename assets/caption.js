// Head of a view: title, what it shows, and the figure as files: pictures, numbers, Python.
export function render({ model }) {
  const make = (tag, attributes = {}, ...children) => {
    const made = document.createElement(tag)
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value)
    made.append(...children)
    return made
  }
  const file = (ending) => `bearing-${model.name_of_files}.${ending}`
  const button = (words, what, act) => {
    const made = make("button", { type: "button", class: `save-${words.toLowerCase()}`, title: what,
                                  "aria-label": `“${model.title}”: ${what}` }, words)
    made.addEventListener("click", act)
    return made
  }
  // Bokeh's figures, or the drawing that the view has instead.
  const views = () => model.picture
    ? [drawing_of(find_deep(files.getRootNode().host.getRootNode(), "svg.picture"))]
    : figures_on_screen(model.figures)
  const failed = (error) => console.warn("the figure could not be saved", error)
  const pictures = [
    button("PNG", `save the picture (${file("png")})`, () =>
      figures_as_png(views()).then((blob) => save_file(file("png"), blob), failed)),
    button("SVG", `save the picture as a drawing (${file("svg")})`, () =>
      save_file(file("svg"), figures_as_svg(views(), model.title), "image/svg+xml")),
  ]
  const offer = () => { for (const one of pictures) one.hidden = !(model.figures.length || model.picture) }
  model.on("figures", offer)
  offer()
  const numbers = button("CSV", `save the numbers (${file("csv")})`, () => model.send_msg("csv"))
  const python = button("Python", "show the lines of Python that make it", () => model.send_msg("python"))

  // The lines, to be copied or saved
  const code = make("pre", { tabindex: "0", "aria-label": "Lines of Python" })
  const said = make("span", { "aria-live": "polite" })
  const copy = make("button", { type: "button" }, "Copy")
  copy.addEventListener("click", async () => {
    if (await copy_text(code.textContent)) said.textContent = "Copied."
    else {
      getSelection().selectAllChildren(code)
      said.textContent = "Marked: copy by hand."
    }
  })
  const save = make("button", { type: "button" }, "Save")
  save.addEventListener("click", () => save_file(file("py"), code.textContent, "text/x-python"))
  const close = make("button", { type: "button", class: "close", "aria-label": "Close" }, "\u00d7")
  const dialog = make("dialog", { "aria-label": `Python for “${model.title}”` },
    make("div", { class: "bar" }, make("strong", {}, `${model.title} in Python`), said, copy, save, close), code)
  close.addEventListener("click", () => dialog.close())
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close() })

  model.on("msg:custom", (message) => {
    if (message.csv !== undefined) save_file(file("csv"), message.csv, "text/csv")
    if (message.python !== undefined) {
      code.textContent = message.python || "Nothing is drawn yet."
      said.textContent = ""
      dialog.showModal()
      copy.focus()
    }
  })
  const files = make("div", { class: "files", role: "group", "aria-label": `“${model.title}” as files` },
    ...pictures, numbers, python)
  const grey = make("p", { class: "grey" })
  const tell = () => {
    grey.hidden = !model.pinned
    grey.textContent = `Grey is the pinned scene “${model.pinned}”.`
  }
  model.on("pinned", tell)
  tell()
  const words = make("div", { class: "words" }, make("h2", {}, model.title),
    make("p", {}, model.about), grey)
  return make("header", {}, words, files, dialog)
}
