// The bar above the controls. What changes the scene goes the way of the sliders: it carries the
// number of the change, so that everybody knows when it is drawn. Scenes that are kept lie in this
// browser; what lies there may have been written by anything, and is looked at before it is used.

const KEPT = "bearing-explorer.kept.1"
const MOST_KEPT = 50
const LONGEST_NAME = 60
const LONGEST_TEXT = 2.5e6

function read_kept() {
  try {
    const found = JSON.parse(localStorage.getItem(KEPT) ?? "[]")
    if (!Array.isArray(found)) return []
    return found.filter((item) => item !== null && typeof item === "object"
        && typeof item.name === "string" && typeof item.text === "string"
        && item.name.trim() && item.text.length <= LONGEST_TEXT)
      .map(({ name, text }) => ({ name: name.slice(0, LONGEST_NAME), text })).slice(0, MOST_KEPT)
  } catch {
    return []  // not allowed to look, or not what we wrote
  }
}

export function render({ model }) {
  const button = (words, title, act, attributes = {}) => {
    const made = element("button", { type: "button", title, ...attributes }, words)
    if (act) made.addEventListener("click", act)
    return made
  }

  // Steps
  const undo = button("Undo", "Undo the last step (Ctrl+Z)", () => ask(model, { undo: true }))
  const redo = button("Redo", "Do it again (Ctrl+Shift+Z or Ctrl+Y)", () => ask(model, { redo: true }))
  const reset = button("Reset", "Back to the numbers of this bearing", () => ask(model, { reset: true }))

  // Menus: each opens below its button and closes by Escape or a click beside it.
  const menu = (words, title, name, ...children) => {
    const panel = element("div", { class: `menu menu-${name}`, popover: "auto", id: `share-${name}`,
                                role: "dialog", "aria-label": title }, ...children)
    const opener = button(words, title, null,
                          { class: "opener", "aria-haspopup": "dialog" })
    opens_below(opener, panel, 340)
    return { opener, panel }
  }

  // Share: the link
  const link = element("input", { type: "text", readonly: "", id: "share-link", spellcheck: "false" })
  link.addEventListener("focus", () => link.select())
  const copy = button("Copy link", "Copy the address of this scene", async () => {
    const copied = await copy_text(link.value)
    if (!copied) {
      link.focus()
      link.select()
    }
    say(copied || document.execCommand("copy") ? "The link is copied." : "Copy the marked link by hand.")
  }, { class: "main" })
  const left_out = element("p", { class: "note" }, "The measured floor is too long for a link: with it "
    + "the scene opens with a flat floor. Save the scene as a file instead, under Download.")
  const share = menu("Share", "Share this scene", "share",
    element("label", { for: "share-link" }, "Whoever opens this link sees this scene, tab and cage angle."),
    link, copy, left_out)

  // Keep: scenes with names, and the one that grey stands for
  const name = element("input", { type: "text", id: "share-name", maxlength: String(LONGEST_NAME),
                               autocomplete: "off", placeholder: "A name for this scene" })
  const keep = element("button", { type: "submit", class: "main" }, "Keep")
  const pin_here = button("Pin as grey", "Let grey show this scene, so that others can be compared with it",
                          () => ask(model, { pin_here: name.value || "this scene" }))
  const form = element("form", {}, element("label", { for: "share-name" }, "Keep this scene in this browser"),
                    name, element("div", { class: "row" }, keep, pin_here))
  form.addEventListener("submit", (event) => {
    event.preventDefault()
    model.send_msg({ keep: name.value })
  })
  const pinned = element("p", { class: "pinned" })
  const unpin = button("Unpin", "Let grey show the bearing without its defect", () => ask(model, { unpin: true }))
  const list = element("ul", { class: "kept", "aria-label": "Kept scenes" })
  const kept_words = element("p", { class: "note", role: "status" })
  const bookmarks_menu = menu("Keep", "Keep and compare scenes", "keep", form,
    element("div", { class: "grey" }, pinned, unpin), list, kept_words)

  const save_kept = (items) => {
    try {
      localStorage.setItem(KEPT, JSON.stringify(items))
      return true
    } catch {
      say("This browser has no room for scenes, or may not keep them. Save it as a file instead, under Download.")
      return false
    }
  }
  const list_kept = () => {
    const items = read_kept()
    list.replaceChildren(...items.map((item) => {
      const open = button(item.name, `Open “${item.name}”`, () => ask(model, { open: item }), { class: "open" })
      const pin = button("Pin", `Let grey show “${item.name}”`, () => ask(model, { pin: item }),
                         { "aria-label": `Pin “${item.name}” as grey` })
      const remove = button("\u00d7", `Remove “${item.name}”`, () => {
        save_kept(read_kept().filter((other) => other.name !== item.name))
        list_kept()
        name.focus()
      }, { "aria-label": `Remove “${item.name}”`, class: "remove" })
      return element("li", {}, open, pin, remove)
    }))
    kept_words.textContent = items.length ? "Open one, or pin it: grey then shows it in every figure."
      : "No scene is kept in this browser yet."
  }
  window.addEventListener("storage", (event) => { if (event.key === KEPT) list_kept() })

  // Download, and back from a file
  const about = {}
  const report = button("Report of this scene (HTML)", "One page with numbers, warnings and figures",
                        () => {
    say("Making the report \u2026")
    const told = Object.fromEntries(Object.entries(about).map(([name, box]) => [name, box.value]))
    model.send_msg({ report: location.origin + location.pathname, ...told })
  })
  const toml = button("Scene (TOML)", "A text file for this page and for Python: Scene.from_toml",
                      () => model.send_msg({ want: "toml" }))
  const file = element("input", { type: "file", accept: ".toml,application/toml,text/plain", id: "share-file" })
  file.addEventListener("change", async () => {
    const chosen = file.files[0]
    if (!chosen) return
    if (chosen.size > 2e6) say(`${chosen.name} is larger than 2 MB.`)
    else ask(model, { file: { name: chosen.name, text: await chosen.text() } })
    file.value = ""
  })
  const own_words = (name, words, box) => {
    about[name] = box
    return [element("label", { for: box.id }, words), box]
  }
  const told_of = element("details", {}, element("summary", {}, "Title, machine and remarks of the report"),
    ...own_words("title", "Title", element("input", { type: "text", id: "report-title", maxlength: "120" })),
    ...own_words("machine", "Machine", element("input", { type: "text", id: "report-machine", maxlength: "200" })),
    ...own_words("remarks", "Remarks", element("textarea", { id: "report-remarks", maxlength: "4000", rows: "3" })))
  const download = menu("Download", "Save and load files", "download", report, told_of, toml,
    element("label", { for: "share-file" }, "Load a scene from a TOML file"), file,
    element("p", { class: "note" },
         "“Export” above each figure has its picture (PNG, SVG), its numbers (CSV) and its lines of Python."))

  // What happened, in a sentence
  const words = element("p", { role: "status" })
  const close = button("\u00d7", "Close", () => { notice.hidden = true }, { "aria-label": "Close this note" })
  const notice = element("div", { class: "notice", hidden: "" }, words, close)
  const say = (sentence) => {
    words.textContent = sentence
    notice.hidden = !sentence
    if (sentence) for (const { panel } of [share, bookmarks_menu, download]) panel.hidePopover()
  }

  const bar = element("div", { class: "bar", role: "group", "aria-label": "Steps and files" },
    undo, redo, reset, element("i", { class: "gap", "aria-hidden": "true" }),
    share.opener, bookmarks_menu.opener, download.opener)
  const root = element("div", { class: "share" }, bar, notice, share.panel, bookmarks_menu.panel, download.panel)

  let shown = null, said = null
  const take = () => {
    const { address, whole, undo: back, redo: again, pinned: grey, said: sentence } = model.state
    undo.disabled = !back
    redo.disabled = !again
    link.value = `${location.origin}${location.pathname}?${address}`
    left_out.hidden = whole
    pinned.textContent = grey ? `Grey: “${grey}”.` : "Grey: the bearing without its defect."
    unpin.hidden = !grey
    // The first is that of the page as it was opened: what is in the address stays, even if it
    // could not be read. Replacing, not pushing: Back leaves the page, as people expect.
    if (shown !== null && shown !== address) history.replaceState(history.state, "", `?${address}`)
    shown = address
    if (said !== sentence.number) say(sentence.words)
    said = sentence.number
  }
  model.on("state", take)
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
        list_kept()
        kept_words.textContent = `“${kept.name}” is kept in this browser.`
      }
    }
    const lost = (error) => {
      console.warn("the report could not be made", error)
      say("The report could not be made.")
    }
    if (page === null) lost("on the server")
    if (page) make_report(page).then((name) => say(`${name} is saved.`), lost)
  })

  // Keys: not where text is typed, which has an undo of its own.
  const keys = (event) => {
    if (!root.isConnected) return window.removeEventListener("keydown", keys)
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return
    const at = event.composedPath()[0]
    if (at instanceof Element && at.matches("textarea, input:not([type=range]):not([type=file])")) return
    const key = event.key.toLowerCase()
    const wanted = key === "z" ? (event.shiftKey ? redo : undo) : key === "y" ? redo : null
    if (wanted === null) return
    event.preventDefault()
    if (!wanted.disabled) wanted.click()
  }
  window.addEventListener("keydown", keys)
  list_kept()
  take()
  return root
}
