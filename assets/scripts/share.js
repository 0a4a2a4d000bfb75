// The bar above the controls. What changes the scene carries the number of the change, as the sliders
// do. Scenes that are kept lie in this browser, and are checked before they are used.

const KEPT = "bearing-explorer.kept.1"
const MOST_KEPT = 50
const MOST_COMPARED = 4
const LONGEST_NAME = 60
const LONGEST_TEXT = 2.5e6
const LARGEST_FILE = 2e6  // bytes

function read_kept() {
  try {
    return JSON.parse(localStorage.getItem(KEPT) ?? "[]")
      .filter((item) => typeof item?.name === "string" && typeof item.text === "string"
        && item.name.trim() && item.text.length <= LONGEST_TEXT)
      .map(({ name, text }) => ({ name: name.slice(0, LONGEST_NAME), text })).slice(0, MOST_KEPT)
  } catch {
    return []  // not allowed to look, or not what was written here
  }
}

export function render({ model }) {
  const tool = (words, title, act, attributes = {}) => button(words, act, { title, ...attributes })
  const asks = (message) => () => ask(model, message)
  const field = (label, box) => [element("label", { for: box.id }, label), box]
  const menus = []
  // Each menu opens below its button and closes by Escape or a click outside.
  const menu = (words, title, name, ...children) => {
    const panel = element("div", { class: `menu menu-${name}`, popover: "auto", id: `share-${name}`,
                                   role: "dialog", "aria-label": title }, ...children)
    const opener = element("button", { type: "button", title, class: "opener", "aria-haspopup": "dialog" }, words)
    opens_below(opener, panel, 340)
    menus.push({ opener, panel })
  }

  // What happened, in a sentence
  const words = element("p", { role: "status" })
  const notice = element("div", { class: "notice", hidden: "" }, words,
    tool("\u00d7", "Close", () => { notice.hidden = true }, { "aria-label": "Close this note" }))
  const say = (sentence) => {
    words.textContent = sentence
    notice.hidden = !sentence
    if (sentence) for (const { panel } of menus) panel.hidePopover()
  }

  // Steps
  const undo = tool("Undo", "Undo the last step (Ctrl+Z)", asks({ undo: true }))
  const redo = tool("Redo", "Do it again (Ctrl+Shift+Z or Ctrl+Y)", asks({ redo: true }), { class: "redo" })
  const reset = tool("Reset", "Back to the numbers of this bearing", asks({ reset: true }))

  // Share: the link
  const link = element("input", { type: "text", readonly: "", id: "share-link", spellcheck: "false" })
  link.addEventListener("focus", () => link.select())
  const copy = tool("Copy link", "Copy the address of this scene", async () => {
    const copied = await copy_text(link.value)
    if (!copied) link.focus()
    say(copied || document.execCommand("copy") ? "The link is copied."
      : "The link is selected: copy it with the keyboard.")
  }, { class: "main" })
  const left_out = element("p", { class: "note" }, "The measured floor is too long for a link: with it "
    + "the scene opens with a flat floor. Save the scene as a file instead, under Download.")
  menu("Share", "Share this scene", "share",
    ...field("This link opens the current scene, tab and cage angle.", link), copy, left_out)

  // Compare: scenes with names that are drawn too, and those that are kept
  const name = element("input", { type: "text", id: "share-name", maxlength: String(LONGEST_NAME),
                                  autocomplete: "off" })
  const compare = element("button", { type: "submit", class: "main",
                                      title: "Draw this scene with every other, as curves of its own" }, "Compare")
  const form = element("form", {}, ...field("Name of this scene", name), element("div", { class: "row" }, compare,
    tool("Keep", "Keep this scene in this browser", () => model.send_msg({ keep: name.value || name.placeholder }))))
  form.addEventListener("submit", (event) => {
    event.preventDefault()
    ask(model, { compare_here: name.value })
    name.value = ""
  })
  const compared = element("ul", { class: "compared", "aria-label": "Compared scenes" })
  const list_compared = (names) => compared.replaceChildren(...names.map((own, number) => {
    const box = element("input", { type: "text", maxlength: String(LONGEST_NAME), "aria-label": `Name of curve ${number + 1}` })
    box.value = own
    box.addEventListener("change", () => ask(model, { number, rename: box.value }))
    return element("li", {}, element("i", { class: `line line-${number}`, "aria-hidden": "true" }), box,
      tool("\u00d7", `Compare “${own}” no longer`, asks({ number, remove: true }),
           { "aria-label": `Remove curve “${own}”`, class: "remove" }))
  }))
  const list = element("ul", { class: "kept", "aria-label": "Kept scenes" })
  const kept_words = element("p", { class: "note", role: "status" })
  menu("Compare", "Compare and keep scenes", "compare", form, compared, list, kept_words)
  const save_kept = (items) => {
    try {
      localStorage.setItem(KEPT, JSON.stringify(items))
    } catch {
      say("This browser has no room for scenes, or may not keep them. Save it as a file instead, under Download.")
      return false
    }
    list_kept()
    return true
  }
  const list_kept = () => {
    const items = read_kept()
    list.replaceChildren(...items.map((item) => element("li", {},
      tool(item.name, `Open “${item.name}”`, asks({ open: item }), { class: "open" }),
      tool("Compare", `Draw “${item.name}” too`, asks({ compare: item }), { "aria-label": `Compare “${item.name}”` }),
      tool("\u00d7", `Remove “${item.name}”`, () => {
        save_kept(read_kept().filter((other) => other.name !== item.name))
        name.focus()
      }, { "aria-label": `Remove “${item.name}”`, class: "remove" }))))
    kept_words.textContent = items.length ? "Kept scenes: open or compare one."
      : "No scene is kept in this browser yet."
  }
  window.addEventListener("storage", (event) => { if (event.key === KEPT) list_kept() })

  // Download, and back from a file
  const about = {
    title: element("input", { type: "text", id: "report-title", maxlength: "120" }),
    machine: element("input", { type: "text", id: "report-machine", maxlength: "200" }),
    remarks: element("textarea", { id: "report-remarks", maxlength: "4000", rows: "3" }),
  }
  const asks_report = (measured) => {
    say("Making the report …")
    const texts = Object.entries(about).map(([name, box]) => [name, box.value])
    model.send_msg({ report: location.origin + location.pathname, measured, ...Object.fromEntries(texts) })
  }
  const report = tool("Report of this scene (HTML)", "One page with numbers, warnings and figures",
                      () => asks_report(false))
  const toml = tool("Scene (TOML)", "A text file for this page and for Python: Scene.from_toml",
                    () => model.send_msg({ want: "toml" }))
  const file = element("input", { type: "file", accept: ".toml,application/toml,text/plain", id: "share-file" })
  sends_text(file, LARGEST_FILE, say, (text) => ask(model, { file: text }))
  menu("Download", "Save and load files", "download", report,
    element("details", {}, element("summary", {}, "Title, machine and remarks of the report"),
      ...field("Title", about.title), ...field("Machine", about.machine), ...field("Remarks", about.remarks)),
    toml, ...field("Load a scene from a TOML file", file),
    element("p", { class: "note" },
      "“Export” above each figure has its picture (PNG, SVG), its numbers (CSV) and its lines of Python."))

  const bar = element("div", { class: "bar", role: "group", "aria-label": "Steps and files" },
    undo, redo, reset, element("i", { class: "gap", "aria-hidden": "true" }), ...menus.map(({ opener }) => opener))
  const root = element("div", { class: "share" }, bar, notice, ...menus.map(({ panel }) => panel))

  const place_of = (text) => {
    const said = new URLSearchParams(text)
    return { tab: said.get("tab") ?? "", lesson: said.get("lesson") ?? "" }
  }
  let shown = null, said = null, named = ""
  let going = null  // the tab that Back leads to, until it is shown
  follow(model, ["state"], () => {
    const { address, whole, undo: back, redo: again, said: sentence } = model.state
    undo.disabled = !back
    redo.disabled = !again
    link.value = `${location.origin}${location.pathname}?${address}`
    Object.assign(document.documentElement.dataset, { scene: model.state.scene, link: link.value })  // for pictures
    left_out.hidden = whole
    name.placeholder = model.state.usual_name
    compare.disabled = model.state.compared.length >= MOST_COMPARED
    if (named !== (named = model.state.compared.join("\n"))) list_compared(model.state.compared)
    // The first is that of the page as it was opened: what is in the address stays, even if it
    // could not be read. Back goes to the last tab or lesson; changes of the scene are undone by Undo.
    const place = place_of(address)
    const there = going === null || place.tab === going
    if (there) going = null
    if (shown === null) history.replaceState(place, "")
    else if (there && shown !== address) {
      const moved = place.tab !== history.state?.tab || place.lesson !== history.state?.lesson
      history[moved ? "pushState" : "replaceState"](place, "", `?${address}`)
    }
    shown = address
    if (said !== sentence.number) say(sentence.words)
    said = sentence.number
  })
  const gone_back = ({ state: place }) => {
    if (!root.isConnected) return window.removeEventListener("popstate", gone_back)
    if (!place) return
    if (place.lesson !== place_of(shown).lesson) announce("lessons", { name: place.lesson })
    const from = going ?? place_of(shown).tab
    going = place.tab
    if (place.tab !== from) announce("show", place.tab)
  }
  window.addEventListener("popstate", gone_back)
  on_event("said", root, say)
  on_event("measured-report", root, () => asks_report(true))
  on_event("asked", root, ({ name }) => { if (name !== going) going = null })
  const failed = (error) => {
    console.warn("the report could not be made", error)
    say("The report could not be made.")
  }
  model.on("msg:custom", ({ file: saved, kept, report: page }) => {
    if (saved) {
      save_file(saved.name, saved.text, saved.type)
      say(`${saved.name} is saved.`)
    }
    if (kept) {
      const others = read_kept().filter((item) => item.name !== kept.name)
      if (others.length >= MOST_KEPT) say(`${MOST_KEPT} scenes are kept; remove one first.`)
      else if (save_kept([kept, ...others])) {
        name.value = ""
        kept_words.textContent = `“${kept.name}” is kept in this browser.`
      }
    }
    if (page === null) failed("on the server")
    else if (page) make_report(page).then((name) => say(`${name} is saved.`), failed)
  })

  // Keys: not where text is typed, which has an undo of its own.
  const keys = (event) => {
    if (!root.isConnected) return window.removeEventListener("keydown", keys)
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return
    const [at] = event.composedPath()
    if (at instanceof Element && at.matches("textarea, input:not([type=range]):not([type=file])")) return
    const key = event.key.toLowerCase()
    const wanted = key === "z" ? (event.shiftKey ? redo : undo) : key === "y" ? redo : null
    if (wanted) event.preventDefault()
    wanted?.click()  // one that is disabled does nothing
  }
  window.addEventListener("keydown", keys)
  list_kept()
  return root
}
