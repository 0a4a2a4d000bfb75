// The bar above the controls. What changes the scene carries the number of the change, as the sliders
// do.

const MOST_COMPARED = 4
const LONGEST_NAME = 60
const LARGEST_FILE = 2e6  // bytes

export function render({ model }) {
  const asks = (message) => () => ask(model, message)
  const asks_report = (measured) => {
    say("Making the report …")
    const words = Object.fromEntries(new FormData(part("about")))
    model.send_msg({ report: location.origin + location.pathname, measured, ...words })
  }
  const copy = async () => {
    const copied = await copy_text(link.value)
    if (!copied) link.focus()
    say(copied || document.execCommand("copy") ? "The link is copied."
      : "The link is selected: copy it with the keyboard.")
  }
  const root = markup(SHARE, {
    undo: asks({ undo: true }),
    redo: asks({ redo: true }),
    back: asks({ back: true }),
    reset: asks({ reset: true }),
    copy,
    report: () => asks_report(false),
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
  const say_saved = (file) => {  // which is news for some seconds
    say(`${file} is saved.`)
    passing = setTimeout(say, 6000, "")
  }
  link.addEventListener("focus", () => link.select())
  const take_scene = sends_text(part("scene-file"), LARGEST_FILE, say, (file) => ask(model, { file }),
    (file) => {
      say("")
      announce("other-file", { file, is: "signal" })
    })
  on_event("scene-file", root, take_scene)

  // Scenes with names that are drawn too
  part("compare-form").addEventListener("submit", (event) => {
    event.preventDefault()
    ask(model, { compare_here: name.value })
    name.value = ""
  })
  const list_compared = (names) => part("compared").replaceChildren(...names.map((own, number) => {
    const box = element("input", { type: "text", maxlength: String(LONGEST_NAME), "aria-label": `Name of curve ${number + 1}` })
    box.value = own
    box.addEventListener("change", () => ask(model, { number, rename: box.value }))
    return element("li", {}, element("i", { class: `line line-${number}`, "aria-hidden": "true" }), box,
      button("\u00d7", asks({ number, remove: true }),
        { title: `Compare “${own}” no longer`, "aria-label": `Remove curve “${own}”` }))
  }))

  const place_of = (text) => {
    const said = new URLSearchParams(text)
    return { tab: said.get("tab") ?? "", lesson: said.get("lesson") ?? "" }
  }
  let shown = null, said = null, named = ""
  let going = null  // the tab that Back leads to, until it is shown
  follow(model, ["state"], () => {
    const { address, whole, undo, redo, said: sentence, left, scene, compared, usual_name } = model.state
    part("undo").disabled = !undo
    part("redo").disabled = !redo
    link.value = `${location.origin}${location.pathname}?${address}`
    Object.assign(document.documentElement.dataset, { scene, link: link.value })  // for pictures
    part("left-out").hidden = whole
    name.placeholder = usual_name
    part("compare").disabled = compared.length >= MOST_COMPARED
    if (named !== (named = compared.join("\n"))) list_compared(compared)
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
    part("back").hidden = !left
    said = sentence.number
  })
  window.addEventListener("popstate", ({ state: place }) => {
    if (!place) return
    if (place.lesson !== place_of(shown).lesson) announce("lessons", { name: place.lesson })
    const from = going ?? place_of(shown).tab
    going = place.tab
    if (place.tab !== from) announce("show", place.tab)
  })
  on_event("said", root, say)
  on_event("measured-report", root, () => asks_report(true))
  on_event("asked", root, (tab) => { if (tab.name !== going) going = null })
  const failed = (error) => {
    console.warn("the report could not be made", error)
    say("The report could not be made.")
  }
  model.on("msg:custom", ({ file: saved, report: page }) => {
    if (saved) {
      save_file(saved.name, saved.text, saved.type)
      say_saved(saved.name)
    }
    if (page === null) failed("on the server")
    else if (page) make_report(page).then(say_saved, failed)
  })

  // Keys: not where text is typed, which has an undo of its own.
  window.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return
    const [at] = event.composedPath()
    if (at instanceof Element && at.matches("textarea, input:not([type=range]):not([type=file])")) return
    const key = event.key.toLowerCase()
    const wanted = key === "z" ? (event.shiftKey ? "redo" : "undo") : key === "y" ? "redo" : null
    if (!wanted) return
    event.preventDefault()
    part(wanted).click()  // one that is disabled does nothing
  })
  return root
}
