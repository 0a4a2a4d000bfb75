// The lesson beside the figures. Its words come from the server as HTML that is safe whoever wrote
// it; a button in them carries what it asks for in data-ask.
//
// Other scripts hear of it by the event "explorer-lesson" on the window: which controls it speaks
// of and which figures it marks, or null where none is open. "explorer-lessons" opens and closes.

export function render({ model }) {
  const ask = (message) => {
    window.__asked = (window.__asked || 0) + 1
    model.send_msg({ mark: window.__asked, ...message })
  }
  let open = false
  const count = model.titles.length
  const usable = (number) => number >= 0 && number < count && !model.titles[number][1]
  const next_of = (number, step) => {
    let at = number + step
    while (at >= 0 && at < count && !usable(at)) at += step
    return usable(at) ? at : -1
  }

  const select = element("select", { id: "lesson-choice", "aria-label": "Lesson" })
  model.titles.forEach(([title, fault], number) => {
    const option = element("option", { value: String(number) }, `${number + 1}. ${title}`)
    option.disabled = fault !== ""
    select.append(option)
  })
  const close = element("button", { type: "button", class: "close", "aria-label": "Close the lessons",
    title: "Close the lessons" }, "\u00d7")
  const faults = element("div", { class: "faults" }, ...model.titles.filter(([, fault]) => fault)
    .map(([, fault]) => element("p", {}, fault)))
  const words = element("div", { class: "words" })
  const back = element("button", { type: "button", class: "step back" }, "Back")
  const next = element("button", { type: "button", class: "step next" }, "Next lesson")
  const again = element("button", { type: "button", class: "step again",
    title: "Set the scene that this lesson begins with" }, "Begin again")
  const lesson = element("section", { class: "lesson", "aria-label": "Lesson", hidden: "" },
    element("header", {}, select, close), faults, words,
    element("footer", {}, back, again, next))

  const say = () => {
    const { drag = [], watch = [] } = model.lesson
    const shown = open ? { drag, watch } : null
    document.documentElement.toggleAttribute("data-lesson", open)
    window.__lesson = shown
    window.dispatchEvent(new CustomEvent("explorer-lesson", { detail: shown }))
  }
  const show = () => {
    const { number, title, parts } = model.lesson
    if (title === undefined) return
    select.value = String(number)
    const heading = element("h2", { tabindex: "-1" }, title)
    const blocks = parts.map(({ heading, html }, index) => {
      const body = element("div", { class: "body" })
      body.innerHTML = html
      const last = index === parts.length - 1
      const part = element("div", { class: last ? "part answer" : "part" }, element("h3", {}, heading), body)
      if (!last) return part
      part.hidden = true
      const reveal = element("button", { type: "button", class: "reveal", "aria-expanded": "false" },
        heading)
      reveal.addEventListener("click", () => {
        part.hidden = false
        reveal.hidden = true
        part.setAttribute("tabindex", "-1")
        part.focus({ preventScroll: true })
        part.scrollIntoView({ block: "start" })
      })
      return element("div", { class: "last" }, reveal, part)
    })
    words.replaceChildren(heading, ...blocks)
    lesson.getRootNode().host?.closest(".lesson-place")?.scrollTo(0, 0)
    back.disabled = next_of(number, -1) < 0
    next.disabled = next_of(number, 1) < 0
    say()
    if (open) heading.focus({ preventScroll: true })
  }
  const go = (number) => { if (number >= 0) ask({ lesson: number }) }
  const toggle = (wanted = !open) => {
    if (open === wanted) return
    open = wanted
    lesson.hidden = !open
    if (open && model.lesson.title === undefined) go(next_of(-1, 1))
    say()
    if (open) (words.querySelector("h2") ?? select).focus({ preventScroll: true })
  }

  words.addEventListener("click", (event) => {
    const button = event.target.closest("[data-ask]")
    if (button) ask(JSON.parse(button.dataset.ask))
  })
  select.addEventListener("change", () => go(Number(select.value)))
  close.addEventListener("click", () => window.dispatchEvent(new CustomEvent("explorer-lessons")))
  back.addEventListener("click", () => go(next_of(model.lesson.number, -1)))
  next.addEventListener("click", () => go(next_of(model.lesson.number, 1)))
  again.addEventListener("click", () => go(model.lesson.number))
  const heard = () => {
    if (lesson.isConnected) toggle()
    else window.removeEventListener("explorer-lessons", heard)
  }
  window.addEventListener("explorer-lessons", heard)
  model.on("lesson", show)
  show()
  return lesson
}
