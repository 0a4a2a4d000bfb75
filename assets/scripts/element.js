// An element of the page with its attributes and children; "html" is its content, written out by us.
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes))
    name === "html" ? (made.innerHTML = value) : made.setAttribute(name, value)
  made.append(...children)
  return made
}

// A button; `act` is called when it is pressed.
function button(words, act, attributes = {}) {
  const made = element("button", { type: "button", ...attributes }, words)
  made.addEventListener("click", act)
  return made
}

// A button that shows and hides a part, which Escape hides too. Returns a function that opens it.
function unfolds(opener, part, changed = () => {}) {
  const open = (shown) => {
    part.hidden = !shown
    opener.setAttribute("aria-expanded", String(shown))
    changed(shown)
  }
  opener.addEventListener("click", () => open(part.hidden))
  for (const where of [opener, part]) where.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || part.hidden) return
    open(false)
    opener.focus()
  })
  open(false)
  return open
}

// The element that an HTML text of ours describes; `acts`: what a click does, by the ids of buttons.
// A menu that closes gives the focus back to the button in front of it.
function markup(text, acts = {}) {
  const { content } = element("template", { html: text })
  for (const [id, act] of Object.entries(acts))
    content.getElementById(id).addEventListener("click", act)
  for (const opener of content.querySelectorAll("[popovertarget]")) {
    const menu = opener.nextElementSibling
    menu.addEventListener("beforetoggle", ({ newState }) => {
      if (newState === "closed" && menu.contains(menu.getRootNode().activeElement)) opener.focus()
    })
  }
  return content.firstElementChild
}

// All elements below a node, those in shadows too.
function* inside(where) {
  for (const found of where.querySelectorAll("*")) {
    yield found
    if (found.shadowRoot) yield* inside(found.shadowRoot)
  }
}

// Calls `write` now and whenever one of these properties of the model changes.
function follow(model, names, write) {
  for (const name of names) model.on(name, write)
  write()
}

// Events of the window that a part hears while it is on the page, and again when a closed tab, which is
// taken out whole, comes back with it.
function while_there(type, part, act) {
  let was_there = false  // a part may hear of something before it is put into the page
  const heard = (event) => {
    if (part.isConnected) was_there = true
    if (part.isConnected) act(event)
    else if (was_there && !part.getRootNode({ composed: true }).matches?.(".section")) removeEventListener(type, heard)
  }
  addEventListener(type, heard)
}

// Events between the scripts of the page: "explorer-" and their name, on the window.
function announce(name, detail) {
  window.dispatchEvent(new CustomEvent(`explorer-${name}`, { detail }))
}
function on_event(name, part, act) {
  while_there(`explorer-${name}`, part, ({ detail }) => act(detail))
}

// The most quotation marks of a text that is sent: a server takes 20,000.
const MOST_QUOTES = 15_000

// Why a text cannot be sent, or nothing: written as JSON it has to fit into a message, and a server
// closes the connection of whoever sends it more.
function unfit(text, largest) {
  if (/[\0\ufffd]/.test(text)) return "is no text file"
  if (text.split('"').length > MOST_QUOTES || JSON.stringify(text).length > 1.5 * largest)
    return "holds more than a file for this place does"
  return ""
}

// Whether the name of a file is that of a scene.
const is_scene_name = (name) => name.toLowerCase().endsWith(".toml")

const SCENE_LINE = /^\s*(\[[\w.[\]]+\]|\w+\s*=)/m

// Reads the text file that is chosen in `input` and sends its name and text; returns a function that
// does so with another file. `other`, if any, takes files that hold no lines of a scene.
function sends_text(input, largest, say, send, other) {
  const take = async (chosen) => {
    const named = !other || is_scene_name(chosen.name)
    if (chosen.size > largest) named ? say(`${chosen.name} is larger than ${largest / 1e6} MB.`, true) : other(chosen)
    else {
      say(`Reading ${chosen.name} …`)
      const text = await chosen.text()
      const why = unfit(text, largest)
      if (!named && (why || !SCENE_LINE.test(text))) other(chosen)
      else if (why) say(`${chosen.name} ${why}. Nothing has changed.`, true)
      else send({ name: chosen.name, text })
    }
  }
  input.addEventListener("change", async () => {
    if (input.files[0]) await take(input.files[0])
    input.value = ""  // so that the same file can be chosen again
  })
  return take
}
