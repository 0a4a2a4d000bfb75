// The bar above the controls. What changes the scene carries the number of the change, as the sliders
// do. Scenes are kept in this browser and are checked before they are used.

const KEPT = "bearing-explorer.kept.1"
const MOST_KEPT = 50
const MOST_COMPARED = 4
const LONGEST_NAME = 60
const LARGEST_FILE = 2e6  // bytes

function read_kept() {
  try {
    return JSON.parse(localStorage.getItem(KEPT) ?? "[]").slice(0, MOST_KEPT)
      .map(({ name, text }) => ({ name: String(name).slice(0, LONGEST_NAME), text: String(text) }))
  } catch {
    return []  // not allowed to look, or not what was written here
  }
}

export function render({ model }) {
  const asks = (message) => () => ask(model, message)
  const copy = async () => {
    const copied = await copy_text(link.value)
    if (!copied) link.focus()
    if (copied || document.execCommand("copy")) say_shortly("The link is copied.")
    else say("The link is selected: copy it with the keyboard.")
  }
  const root = markup(SHARE, {
    undo: asks({ undo: true }),
    redo: asks({ redo: true }),
    reset: () => {
      ask(model, { reset: true })
      for (const zoomed of inside(document)) if (zoomed.matches(".home")) zoomed.click()
    },
    copy,
    keep: () => model.send_msg({ keep: name.value || name.placeholder }),
    toml: () => model.send_msg({ want: "toml" }),
    close: () => { part("notice").hidden = true },
  })
  const part = (id) => root.querySelector(`#${id}`)
  const link = part("link"), name = part("name")
  // What happened, in a sentence
  let passing
  const say = (sentence) => {
    clearTimeout(passing)
    part("said").textContent = sentence
    part("notice").hidden = !sentence
    if (sentence) root.querySelector(":popover-open")?.hidePopover()
  }
  const say_shortly = (sentence) => {  // which is news for some seconds
    say(sentence)
    passing = setTimeout(say, 6000, "")
  }
  link.addEventListener("focus", () => link.select())
  const take_scene = sends_text(part("scene-file"), LARGEST_FILE, say, (file) => ask(model, { file }),
    (file) => {
      say("")
      announce("other-file", { file, is: "signal" })
    })
  on_event("scene-file", root, take_scene)

  // Scenes with names that are drawn too, and those that are kept
  part("compare-form").addEventListener("submit", (event) => {
    event.preventDefault()
    ask(model, { compare_here: name.value })
    name.value = ""
  })
  const tool = (words, title, act, attributes = {}) => button(words, act, { title, ...attributes })
  const list_compared = (names) => part("compared").replaceChildren(...names.map((own, number) =>
    element("li", {}, element("i", { class: `line line-${number}`, "aria-hidden": "true" }),
      element("span", {}, own),
      tool("\u00d7", `Compare “${own}” no longer`, asks({ number, remove: true }),
           { "aria-label": `Remove curve “${own}”` }))))
  const save_kept = (items) => {
    try {
      localStorage.setItem(KEPT, JSON.stringify(items))
    } catch {
      say("This browser has no room for scenes, or may not keep them. Save it as a file instead, under Share.")
      return false
    }
    list_kept()
    return true
  }
  const list_kept = () => {
    const items = read_kept()
    part("kept").replaceChildren(...items.map((item) => element("li", {},
      tool(item.name, `Open “${item.name}”`, asks({ open: item }), { class: "open" }),
      tool("Compare", `Draw “${item.name}” too`, asks({ compare: item }), { "aria-label": `Compare “${item.name}”` }),
      tool("\u00d7", `Remove “${item.name}”`, () => {
        save_kept(read_kept().filter((other) => other.name !== item.name))
        name.focus()
      }, { "aria-label": `Remove “${item.name}”` }))))
    part("kept-words").textContent = items.length ? "Kept scenes: open or compare one."
      : "No scene is kept in this browser yet."
  }
  window.addEventListener("storage", (event) => { if (event.key === KEPT) list_kept() })

  const place_of = (address) => {
    const said = new URLSearchParams(address), [tab, lesson] = ["tab", "lesson"].map((name) => said.get(name) ?? "")
    for (const name of ["tab", "lesson", "cage_angle_deg"]) said.delete(name)
    return { tab, lesson, scene: String(said), address }
  }
  let shown = null, said = null, named = ""
  let changed = false, returning = false  // whether the scene is another than the first; and whether Back or Forward opens one
  let going = null  // the tab that Back leads to, until it is shown
  follow(model, ["state"], () => {
    const { address, whole, undo, redo, said: sentence, scene, compared, usual_name } = model.state
    part("undo").disabled = !undo
    part("redo").disabled = !redo
    link.value = `${location.origin}${location.pathname}?${address}`
    Object.assign(document.documentElement.dataset, { scene, link: link.value })  // for pictures
    part("left-out").hidden = whole
    name.placeholder = usual_name
    part("compare").disabled = compared.length >= MOST_COMPARED
    if (named !== (named = compared.join("\n"))) list_compared(compared)
    // The first is that of the page as it was opened: what is in the address stays, even if it
    // could not be read. Back goes to the last tab or lesson, and to the first scene; Undo to the last one.
    const place = place_of(address)
    const there = going === null || place.tab === going
    if (there) going = null
    if (shown === null) history.replaceState(place, "")
    else if (there && shown !== address) {
      const { tab, lesson, scene } = history.state ?? place, moved = place.tab !== tab || place.lesson !== lesson
      const changes = !moved && !changed && !returning && place.scene !== scene
      changed = place.lesson === lesson && (changed || changes)
      returning = false
      history[moved || changes ? "pushState" : "replaceState"]({ ...place, changed }, "", `?${address}${document.documentElement.hasAttribute("data-projector") ? "#projector" : ""}`)
    }
    shown = address
    if (said !== sentence.number) say(sentence.words)
    else announce("done")  // scene or tab is another one: what was said of a file goes
    said = sentence.number
  })
  window.addEventListener("popstate", ({ state: place }) => {
    if (!place) return
    if (place.lesson !== place_of(shown).lesson) announce("lessons", { name: place.lesson })
    const from = going ?? place_of(shown).tab
    going = place.tab
    if (place.tab !== from) announce("show", place.tab)
    returning = place.lesson === place_of(shown).lesson && Boolean(place.changed) !== changed
    changed = Boolean(place.changed)
    if (returning) ask(model, { open: { name: "The earlier scene", text: place.address } })
  })
  on_event("said", root, say)
  on_event("done", root, () => say(""))
  on_event("measured-report", root, () => {
    say("Making the report …")
    const words = Object.fromEntries(new FormData(part("about")))
    model.send_msg({ report: location.origin + location.pathname, ...words })
  })
  on_event("asked", root, (tab) => { if (tab.name !== going) going = null })
  const failed = (error) => {
    console.warn("the report could not be made", error)
    say("The report could not be made.")
  }
  model.on("msg:custom", ({ file: saved, kept, report: page }) => {
    if (saved) {
      save_file(saved.name, saved.text, saved.type)
      say_shortly(`${saved.name} is saved.`)
    }
    if (kept) {
      const others = read_kept().filter((item) => item.name !== kept.name)
      if (others.length >= MOST_KEPT) say(`${MOST_KEPT} scenes are kept; remove one first.`)
      else if (save_kept([kept, ...others])) {
        name.value = ""
        part("kept-words").textContent = `“${kept.name}” is kept in this browser.`
      }
    }
    if (page === null) failed("on the server")
    else if (page) make_report(page).then((name) => say_shortly(`${name} is saved.`), failed)
  })

  // Keys: not where text is typed, which has an undo of its own.
  window.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return
    const [at] = event.composedPath()
    if (at instanceof Element && at.matches("textarea, input:not([type=range], [type=file], [type=radio])")) return
    const key = event.key.toLowerCase()
    const wanted = key === "z" ? (event.shiftKey ? "redo" : "undo") : key === "y" ? "redo" : null
    if (!wanted) return
    event.preventDefault()
    part(wanted).click()  // one that is disabled does nothing
  })
  list_kept()
  return root
}
