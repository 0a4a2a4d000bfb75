// What belongs to the page as a whole: its buttons, its keys, and marks on figures that a lesson
// speaks of. Runs when the page stands.
{
  const root = document.documentElement
  const lessons = document.getElementById("lessons-button")
  const theme = document.getElementById("theme-button")

  lessons.addEventListener("click", () => window.dispatchEvent(new CustomEvent("explorer-lessons")))
  const beside_lesson = (lesson) => {
    lessons.setAttribute("aria-expanded", String(lesson !== null))
    if (lesson === null && window.explorer_projector.on) window.explorer_projector.turn(false)
    mark(lesson?.watch ?? [])
    mark_as_they_come(show_marked)
  }
  window.addEventListener("explorer-lesson", (event) => beside_lesson(event.detail))

  const show_theme = () => {
    const dark = window.explorer_theme.now === "dark"
    theme.setAttribute("aria-pressed", String(dark))
    theme.title = dark ? "Light colours" : "Dark colours"
  }
  theme.addEventListener("click", () => window.explorer_theme.turn())
  window.addEventListener("explorer-theme", show_theme)
  show_theme()

  // The first visit: what this is, and three ways in. Whoever has closed it finds it behind "?".
  const main = document.querySelector("main")
  const welcome = document.getElementById("welcome")
  const what = document.getElementById("welcome-button")
  const python = document.getElementById("python-door")
  const WELCOMED = "bearing-explorer.welcomed"
  const welcomed = () => { try { return localStorage.getItem(WELCOMED) !== null } catch { return false } }
  let greet = !welcomed()
  const room = () => {
    const height = main.clientHeight - 32 - (welcome.hidden ? 0 : welcome.offsetHeight + 10)
    root.style.setProperty("--room", `${height}px`)
  }
  const show_welcome = () => {
    welcome.hidden = !greet || root.dataset.tab !== "overview"
    what.setAttribute("aria-expanded", String(!welcome.hidden))
    room()
  }
  const end_welcome = () => {
    greet = false
    try { localStorage.setItem(WELCOMED, "1") } catch { /* for this page only */ }
    show_welcome()
  }
  const doors = {
    close: () => { end_welcome(); what.focus() },
    lessons: () => {
      end_welcome()
      window.dispatchEvent(new CustomEvent("explorer-lessons", { detail: "first" }))
    },
    bearing: () => { end_welcome(); window.dispatchEvent(new CustomEvent("explorer-show", { detail: "bearing" })) },
    python: () => python.showModal(),
  }
  for (const door of welcome.querySelectorAll("[data-door]"))
    door.addEventListener("click", doors[door.dataset.door])
  what.addEventListener("click", () => {
    if (!welcome.hidden) return doors.close()
    greet = true
    if (root.dataset.tab === "overview") show_welcome()
    else window.dispatchEvent(new CustomEvent("explorer-show", { detail: "overview" }))
  })
  python.querySelector(".close").addEventListener("click", () => python.close())
  python.addEventListener("click", (event) => { if (event.target === python) python.close() })
  window.addEventListener("explorer-tab", show_welcome)
  new ResizeObserver(room).observe(main)
  new ResizeObserver(room).observe(welcome)

  // A tab that is asked for is built on the server, which may take a while: say so at once.
  const waiting = document.getElementById("waiting")
  let wanted = null  // the tab that is not drawn yet
  const wait_for = (tab, words) => {
    wanted = tab
    main.toggleAttribute("data-waiting", tab !== null)
    main.setAttribute("aria-busy", String(tab !== null))
    waiting.textContent = words
  }
  const stands = () => root.dataset.tab === wanted
  window.addEventListener("explorer-asked", ({ detail: { name, title } }) =>
    wait_for(name, name === root.dataset.tab ? "Computing …" : `${title} is being built …`))
  window.addEventListener("explorer-tab", ({ detail: name }) => {
    if (wanted === null || stands()) wait_for(name, "Computing …")
  })
  window.addEventListener("explorer-drawn", () => { if (wanted !== null && stands()) wait_for(null, "") })

  // Figures come and go with their tabs, each inside the shadow of another.
  const inside = function* (where) {
    for (const element of where.querySelectorAll("*")) {
      yield element
      if (element.shadowRoot) yield* inside(element.shadowRoot)
    }
  }
  let marked = []
  const mark = (views) => {
    marked = views
    const missing = new Set(marked)
    for (const element of inside(document.querySelector("main")))
      if (element.classList.contains("view")) {
        const found = marked.find((view) => element.classList.contains(`view-${view}`))
        element.classList.toggle("watched", found !== undefined)
        missing.delete(found)
      }
    return missing.size === 0
  }
  // A tab that is opened for the first time is built on the server: its figures come when they come.
  const mark_as_they_come = (then = () => {}, tries = 200) => {
    if (mark(marked)) requestAnimationFrame(then)
    else if (tries > 0) setTimeout(() => mark_as_they_come(then, tries - 1), 50)
  }
  // A card that had nothing to show grows by its answer: then it is brought into view again.
  const GROWN = 150  // px
  let followed = null, height = 0
  const growth = new ResizeObserver(([{ contentRect: now }]) => {
    const answered = height > 0 && now.height > height + GROWN
    height = now.height
    if (answered) show_marked()
  })
  const follow_growth = (element) => {
    if (element === followed) return
    growth.disconnect()
    growth.observe(element)
    followed = element
    height = 0
  }
  // The first of the marked figures is brought into view where it is not: its head, if not all of it.
  const show_marked = () => {
    const main = document.querySelector("main")
    const [first] = marked
    for (const element of inside(main)) {
      if (!first || !element.classList.contains(`view-${first}`)) continue
      follow_growth(element)
      const box = element.getBoundingClientRect(), room = main.getBoundingClientRect()
      if (box.height && (box.top < room.top || box.bottom > room.bottom))
        element.scrollIntoView({ block: box.height < room.height ? "nearest" : "start" })
      return
    }
  }

  // Space turns the bearing, unless something else has a use for it.
  window.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.ctrlKey || event.metaKey || event.altKey || event.repeat) return
    const at = event.composedPath()[0]
    if (at instanceof Element && at.closest("textarea, select, button, summary, a[href], [contenteditable], "
        + "input:not([type=range]), [role=dialog], .words")) return
    event.preventDefault()
    window.dispatchEvent(new CustomEvent("explorer-play"))
  })

  // Bokeh writes the style sheet of every part of a figure anew at each paint, the same or not, and
  // the browser then works out the styles of the page again, ten times a picture. Where Bokeh
  // changes what this is hung on, it is done as before.
  const keep_styles = () => {
    let sheet
    try {
      sheet = Bokeh.require("core/dom").InlineStyleSheet.prototype
    } catch {
      return
    }
    const { _update: write } = sheet
    if (write) sheet._update = function (css) {
      if (this.el.textContent !== css) write.call(this, css)
    }
  }

  // Bokeh zooms by the whole of a pinch at each of its steps: a figure runs away where fingers part,
  // and jumps where they come together. Here it stays under them. Where Bokeh changes what this is
  // hung on, it is done as before.
  const pinch_with_fingers = () => {
    let tool
    try {
      tool = Bokeh.require("models/tools/gestures/wheel_zoom_tool").WheelZoomToolView.prototype
    } catch {
      return
    }
    if (!tool._pinch || !tool.zoom) return
    const pinched = new WeakMap()
    tool._pinch_start = function () { pinched.set(this, 1) }
    tool._pinch = function ({ sx, sy, scale }) {
      const by = scale / (pinched.get(this) ?? 1)
      pinched.set(this, scale)
      this.zoom(sx, sy, (1 - 1 / by) / this.model.speed)
    }
  }

  // Figures that come later are marked and coloured as they come.
  const follow = () => {
    window.explorer_theme.follow()
    if (marked.length) mark(marked)
  }
  const begun = () => {
    if (!window.Bokeh?.documents?.length) return setTimeout(begun, 30)
    keep_styles()
    pinch_with_fingers()
    follow()
    let shown = root.dataset.tab
    show_welcome()
    window.addEventListener("explorer-tab", (event) => {
      if (shown === event.detail) return
      shown = event.detail
      requestAnimationFrame(() => mark_as_they_come(show_marked))
    })
  }
  begun()
}
