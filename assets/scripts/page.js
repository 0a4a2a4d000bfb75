// The page as a whole: its buttons, its keys, and the figures that a lesson speaks of. Runs when the
// page stands, behind element.js.
{
  const root = document.documentElement
  const main = document.querySelector("main")
  const part = (name) => document.getElementById(name)
  const lessons = part("lessons-button"), theme = part("theme-button")

  lessons.addEventListener("click", () => announce("lessons"))
  on_event("lesson", root, (lesson) => {
    lessons.setAttribute("aria-expanded", String(lesson !== null))
    marked = lesson?.watch ?? []
    veiled = lesson?.veiled ?? []
    mark_as_they_come(show_marked)
  })
  on_event("predicted", root, () => { veiled = []; mark() })

  // On a phone the controls are folded on tabs where they matter little, see page.css.
  const scene = part("scene-button")
  const unfold_scene = (open) => scene.setAttribute("aria-expanded", String(open))
  scene.addEventListener("click", () => unfold_scene(scene.getAttribute("aria-expanded") !== "true"))
  on_event("tab", root, () => unfold_scene(false))

  const show_theme = () => theme.setAttribute("aria-pressed", String(root.dataset.theme === "dark"))
  theme.addEventListener("click", () => announce("turn-theme"))
  on_event("theme", root, show_theme)
  show_theme()

  // The first visit: what this is. Once closed it is found behind "?", in the help.
  const WELCOMED = "bearing-explorer.welcomed"
  const welcome = part("welcome"), help = part("help"), help_button = part("help-button")
  let greet = true
  try { greet = localStorage.getItem(WELCOMED) === null } catch { /* each time, then */ }
  // Figures keep their size under a hand: a line of warnings in the foot does not take it from them.
  const footer = document.querySelector("footer")
  let foot = 0, touched = false  // height of the foot [px] before anything was pressed
  for (const press of ["pointerdown", "keydown"]) window.addEventListener(press, () => { touched = true }, true)
  const room = () => {
    if (!touched) foot = footer.offsetHeight
    const height = main.clientHeight + footer.offsetHeight - foot - 32 - (welcome.hidden ? 0 : welcome.getBoundingClientRect().height + 10)
    root.style.setProperty("--room", `${height}px`)
    // a sheet is 700 px wide, and figures are as wide as on screen
    if (matchMedia("screen").matches) root.style.setProperty("--on-paper", Math.min(1, 700 / main.clientWidth))
  }
  const show_welcome = () => {
    welcome.hidden = !greet || root.dataset.tab !== "overview"
    touched = false
    room()
  }
  const set_greet = (wanted) => {
    greet = wanted
    try { localStorage.setItem(WELCOMED, "1") } catch { /* for this page only */ }
    show_welcome()
  }
  part("longer-button").addEventListener("click", () => announce("longer"))
  part("welcome-close").addEventListener("click", () => { set_greet(false); help_button.focus() })
  help_button.addEventListener("click", () => help.showModal())
  const doors = {
    lessons: () => announce("lessons", "first"),
    bearing: () => announce("show", "bearing"),
    projector: () => announce("projector", !root.hasAttribute("data-projector")),
    introduction: () => { set_greet(true); announce("show", "overview") },
  }
  for (const door of help.querySelectorAll("[data-door]"))
    door.addEventListener("click", () => { help.close(); doors[door.dataset.door]() })
  for (const event of ["tab", "projector", "lesson"]) on_event(event, root, show_welcome)
  window.addEventListener("resize", show_welcome)
  for (const box of [main, welcome]) new ResizeObserver(room).observe(box)

  // A tab that is asked for is built on the server, which may take a while: the page says so at once.
  const waiting = part("waiting")
  let wanted = null  // the tab that is not drawn yet
  const wait_for = (tab, words) => {
    wanted = tab
    main.toggleAttribute("data-waiting", tab !== null)
    main.setAttribute("aria-busy", String(tab !== null))
    waiting.textContent = words
  }
  const is_open = () => root.dataset.tab === wanted
  on_event("asked", root, ({ name, title }) =>
    wait_for(name, name === root.dataset.tab ? "Computing …" : `${title} is being built …`))
  on_event("tab", root, (name) => { if (wanted === null || is_open()) wait_for(name, "Computing …") })
  on_event("drawn", root, () => { if (wanted !== null && is_open()) wait_for(null, "") })

  // Figures come and go with their tabs, each inside the shadow of another.
  const NARROW = 820  // px
  let marked = [], veiled = []  // veiled: they would answer what is to be predicted
  const mark = () => {
    const missing = new Set([...marked, ...veiled])
    for (const view of inside(main)) {
      if (!view.classList.contains("view")) continue
      const is = (name) => view.classList.contains(`view-${name}`)
      const hidden = veiled.some(is), parts = answers_in(view)
      view.classList.toggle("watched", marked.some(is))
      view.classList.toggle("veiled", hidden)
      view.classList.toggle("in-part", parts.length > 0)
      for (const part of parts) if (part.visible === hidden) part.setv({ visible: !hidden }, { sync: false })
      for (const name of [...missing]) if (is(name)) missing.delete(name)
    }
    // on a phone there is room for the question, or for them
    if (innerWidth <= NARROW) show_choices(main, !root.hasAttribute("data-asks"))
    // those of another tab come when that is opened
    return veiled.every((name) => !missing.has(name)) && (!marked.length || marked.some((name) => !missing.has(name)))
  }
  const figures_in = (view) => [...Bokeh.index.query(({ model, el }) => {
    if (model.type !== "Figure") return false
    for (let at = el; at; at = at.parentElement ?? at.getRootNode().host) if (at === view) return true
  })]
  // What a view has tagged as the answer in its figures: the rest of them need not be veiled.
  const answers_in = (view) => figures_in(view)
    .flatMap(({ model }) => [...model.renderers, ...model.below]).filter(({ tags }) => tags.includes("answer"))
  // A tab that is opened for the first time is built on the server: its figures come when they come.
  const mark_as_they_come = (then, tries = 200) => {
    if (mark()) requestAnimationFrame(then)
    else if (tries > 0) setTimeout(() => mark_as_they_come(then, tries - 1), 50)
  }
  // A card that had nothing to show grows by its answer: then it is brought into view again.
  const GROWN = 150  // px
  let followed = null, height = 0, opened = null  // the last that was opened, of those that are folded
  const growth = new ResizeObserver(([{ contentRect: now }]) => {
    if (height > 0 && now.height > height + GROWN) show_marked()
    height = now.height
  })
  // The first of the marked figures, or one that was opened, is brought into view: its head, where there
  // is no room for all.
  const show_marked = () => {
    const views = [...inside(main)].filter((one) => one.matches(".view.watched") && one.getClientRects().length)
    const view = views.find((one) => one === opened) ?? views[0]
    if (!view) return
    if (view !== followed) {
      growth.disconnect()
      growth.observe(view)
      followed = view
      height = 0
    }
    const box = view.getBoundingClientRect(), room = main.getBoundingClientRect()
    if (box.height && (box.top < room.top || box.bottom > room.bottom))
      view.scrollIntoView({ block: box.height < room.height ? "nearest" : "start" })
  }

  // For a projector all words are larger: parts without figures as a whole, while figures have type of
  // their own (look.js), and views are below one another. With a lesson only the views that it marks
  // are there, two of them side by side, and their figures have the height that there is.
  // Handles in a figure stand in its pixels.
  const LARGER = 1.64, WIDTH_OF_SIGN = 12  // px
  const enlarge_words = () => {
    const large = root.hasAttribute("data-projector")
    const has_figure = (part) => {
      if (part.localName === "canvas") return true
      if (part.classList.contains("section")) {
        const views = [...inside(part.shadowRoot)].filter((one) => one.matches(".view"))
        const shown = views.filter((view) => view.matches(".watched") && view.getClientRects().length)
        const alone = large && root.hasAttribute("data-lesson") && shown.length > 0
        part.classList.toggle("one-column", large)
        part.classList.toggle("two-columns", alone && shown.length === 2 && !shown.some((view) => view.matches(".veiled:not(.in-part)")))
        part.classList.toggle("marked-only", alone)
      }
      const parts = [...part.children, ...(part.shadowRoot?.children ?? [])].filter((one) => one.style && !one.matches(".handle, .cue"))
      const drawn = new Set(parts.filter(has_figure))
      for (const one of drawn.size ? parts : []) one.style.zoom = large && !drawn.has(one) ? LARGER : ""
      return drawn.size > 0 || part === main  // its figures may not have come yet
    }
    has_figure(document.body)
    setTimeout(fit, 120)
  }
  const in_two_lines = (words) => {
    const middle = words.length / 2, off = (at) => Math.abs(at - middle)
    const spaces = [...words.matchAll(/ /g)].map(({ index }) => index).sort((a, b) => off(a) - off(b))
    return spaces.length ? `${words.slice(0, spaces[0])}\n${words.slice(spaces[0] + 1)}` : words
  }
  const own_size = new Map()  // of figures that are fitted
  const resize = (model, height, room_for_labels = 1) => {
    const { sizing_mode, height: own, min_height, min_border_left } = model
    if (!own_size.has(model)) own_size.set(model, { sizing_mode, height: own, min_height, min_border_left })
    const wider = { min_border_left: room_for_labels * own_size.get(model).min_border_left }
    model.setv({ sizing_mode: "stretch_width", height, min_height: null, ...wider }, { sync: false })
  }
  // Without a lesson, or beside one on a low screen: the head of a view and its first figure at once.
  const LEAST = 170, LOW = 460  // px
  const fit_first_row = (view, plots, room) => {
    const least = Math.min(...plots.map(([, { top }]) => top)) - view.getBoundingClientRect().top
    const high = Math.max(LEAST, Math.floor(room - least - 8))
    for (const [model, { height }] of plots) if (height > high + 1) resize(model, high)
  }
  const is_fitted = () => root.hasAttribute("data-projector") || (innerHeight <= LOW && root.hasAttribute("data-lesson"))
  const fit = () => {
    if (!is_fitted()) return
    const views = [...inside(main)].filter((one) => one.matches(".view") && one.getClientRects().length)
    const drawn_in = (view) => figures_in(view).map(({ model, el }) => [model, el.getBoundingClientRect()]).filter(([, { height }]) => height)
    const room = main.clientHeight - 2 * parseFloat(getComputedStyle(main).paddingTop)
    if (!root.hasAttribute("data-lesson") || innerHeight <= LOW) return views.forEach((view) => fit_first_row(view, drawn_in(view), room))
    for (const view of views) {  // what waits to be opened stands beside the figure
      const was_folded = view.matches(".folded")
      if (was_folded > view.classList.toggle("folded", view.matches(".watched") && !drawn_in(view).length)) opened = view
      if (view.matches(".watched")) view.getRootNode().host.classList.toggle("beside", views.some((one) => one.matches(".folded")))
    }
    const folded = views.filter((one) => one.matches(".folded"))
    for (const view of views.filter((one) => !folded.includes(one))) {
      const fits = views.length === 1 || view.matches(".watched")
      show_choices(view, !fits || !(root.hasAttribute("data-asks") || view.getRootNode().host.matches(".two-columns")), folded.at(-1))
      if (!fits) continue
      const box = view.getBoundingClientRect()
      const plots = drawn_in(view)
      const rows = new Map(plots.map(([, { top, height }]) => [Math.round(top), height]))
      const sentence = view.shadowRoot.querySelector(".sentence").getBoundingClientRect()
      const end = Math.max(sentence.bottom, ...plots.map(([, { bottom }]) => bottom))
      const more = box.top + room - parseFloat(getComputedStyle(view).paddingBottom) - 2 - end
      const high = Math.max(60, Math.floor([...rows.values()].reduce((sum, height) => sum + height, more) / rows.size))
      for (const [model, { height }] of plots) if (Math.abs(high - height) >= 1) {
        resize(model, high, 1.15)
        for (const axis of model.left)  // in two lines, where large type is longer than the figure is high
          if (axis.axis_label?.length * WIDTH_OF_SIGN > high && !axis.axis_label.includes("\n")) axis.setv({ axis_label: in_two_lines(axis.axis_label) }, { sync: false })
      }
    }
    requestAnimationFrame(show_marked)  // it may have been scrolled to while it was higher
  }
  // The choices above a figure: there is no room for them beside another one, and no use before the answer.
  // Below what is folded beside the figure they leave its height to it.
  const show_choices = (where, wanted, above) => {
    for (const one of inside(where.shadowRoot ?? where)) if (one.matches(".look")) {
      const from = one.getRootNode().host.getBoundingClientRect(), at = above?.getBoundingClientRect()
      const px = (length) => at ? `${Math.round(length / LARGER)}px` : ""
      Object.assign(one.style, {
        display: wanted ? "" : "none", position: at ? "absolute" : "", width: px(at?.width),
        left: px(at?.left - from.left), top: px(at?.bottom + 10 - from.top),
      })
    }
  }
  const end_fit = () => {
    show_choices(main, true)
    for (const [model, size] of own_size) {
      model.setv(size, { sync: false })
      for (const axis of model.left)
        if (axis.axis_label) axis.setv({ axis_label: axis.axis_label.replace("\n", " ") }, { sync: false })
    }
    own_size.clear()
  }
  // before the type of figures changes, and with it what their height is (look.js)
  on_event("projector", root, end_fit)
  on_event("lesson", root, (lesson) => { if (!lesson) end_fit() })
  new ResizeObserver(() => enlarge_soon()).observe(main)
  let coming = 0
  const enlarge_soon = () => {
    clearTimeout(coming)
    if (is_fitted()) coming = setTimeout(enlarge_words, 120)
  }
  for (const event of ["tab", "laid-out", "lesson", "predicted"]) on_event(event, root, enlarge_soon)
  on_event("projector", root, enlarge_words)

  // A file that was brought to the place of another kind, or dropped anywhere: a scene goes to the bar
  // above the controls, everything else may be a signal.
  const brought = part("other-file")
  let kept_file = null
  const offer = (file, is) => {
    const [words, act] = brought.querySelectorAll("p, .main")
    const scene = is === "scene"
    words.textContent = scene ? `“${file.name}” may be a scene.` : `“${file.name}” may be a measured signal.`
    act.textContent = scene ? "Open the scene" : "Diagnose it"
    act.onclick = () => {
      brought.hidden = true
      unfold_scene(scene)
      if (scene) return announce("scene-file", file)
      kept_file = file
      announce("show", "diagnosis")
      hand_over()
    }
    brought.hidden = false
    brought.scrollIntoView({ block: "nearest" })
    room()
  }
  const hand_over = () => announce("signal-file", { file: kept_file, taken: () => { kept_file = null } })
  if (brought) {
    on_event("other-file", root, ({ file, is }) => offer(file, is))
    on_event("upload-ready", root, () => { if (kept_file) hand_over() })
    brought.querySelector(".close").addEventListener("click", () => { brought.hidden = true; room() })
    on_event("done", root, () => brought.querySelector(".close").click())
    for (const kind of ["dragover", "drop"]) window.addEventListener(kind, (event) => {
      const dropped = event.dataTransfer?.types.includes("Files") && !event.defaultPrevented
      if (!dropped) return
      event.preventDefault()  // the browser would leave the page for the file
      const [file] = event.dataTransfer.files
      if (kind === "drop" && file) offer(file, is_scene_name(file.name) ? "scene" : "signal")
    })
  }

  // While the bearing turns by itself nothing is read out.
  on_event("turning", main, (idle) => main.setAttribute("aria-busy", String(idle)))

  // Space turns the bearing, unless something else has a use for it.
  window.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.ctrlKey || event.metaKey || event.altKey || event.repeat) return
    const [at] = event.composedPath()
    if (at instanceof Element && at.closest("textarea, select, button, summary, a[href], [contenteditable], "
        + "input:not([type=range]), [role=dialog], .words")) return
    event.preventDefault()
    announce("play")
  })

  // Figures have their places after their numbers: the event "laid-out", unless Bokeh has moved the class.
  const announce_layouts = () => {
    let plot, coming
    try { plot = Bokeh.require("models/plots/plot").PlotView.prototype } catch { return }
    const follow = plot.after_layout
    if (follow) plot.after_layout = function () {
      follow.call(this)
      clearTimeout(coming)
      coming = setTimeout(() => announce("laid-out"))
    }
  }

  const begin = () => {
    if (!window.Bokeh?.documents?.length) return setTimeout(begin, 30)
    announce_layouts()
    announce("figures")
    if (location.hash.includes("projector")) announce("projector", true)
    show_welcome()
    let shown = root.dataset.tab
    on_event("tab", root, (tab) => {
      if (shown === tab) return
      shown = tab
      requestAnimationFrame(() => mark_as_they_come(show_marked))
    })
  }
  begin()
}
