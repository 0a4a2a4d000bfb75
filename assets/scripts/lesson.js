// The lessons beside the figures: a list of them, the words of one, its prediction and its answer.
// Words come from the server as safe HTML; a button in them carries its message in data-ask. A scene
// is set when a lesson begins, and never when its words are shown again.
//
// Other scripts get the event "lesson": which controls it names and which figures it marks, or null
// where none is open. The event "lessons" opens and closes them.

const REMEMBERED = "bearing-explorer.lessons"

// What this tab of the browser remembers: the last lesson, and the answers given in each.
function remembered() {
  try {
    return Object(JSON.parse(sessionStorage.getItem(REMEMBERED)))
  } catch {
    return {}
  }
}
function remember(changes) {
  try {
    sessionStorage.setItem(REMEMBERED, JSON.stringify({ ...remembered(), ...changes }))
  } catch { /* for as long as the page is open */ }
}

export function render({ model }) {
  const root = document.documentElement
  const usable = (number) => model.titles[number]?.[1] === ""
  const next_of = (number, step) => {
    for (let at = number + step; at in model.titles; at += step) if (usable(at)) return at
    return -1
  }
  const began = () => model.lesson.title !== undefined
  const place = () => lesson.getRootNode().host?.closest(".lesson-place")
  const key = () => `said.${model.lesson.name || model.lesson.number}`
  const answers = () => Object(remembered()[key()])
  const remember_answer = (answer) => remember({ [key()]: { ...answers(), ...answer } })

  // A teacher's link may keep answers back, for as long as this tab of the browser lasts.
  if (location.hash.includes("hide-answers")) remember({ hides: true })
  const hides = Boolean(remembered().hides)

  let open = false, listed = false  // whether the list is shown instead of a lesson
  let resumed = model.open_first  // whether the lesson that comes was open before, with its answers
  const send_event = () => {
    const { drag = [], watch = [], predict } = began() && !listed ? model.lesson : {}
    const { given, revealed } = answers()
    const veiled = Boolean(predict) && given === undefined && !revealed
    root.toggleAttribute("data-lesson", open)
    announce("lesson", open ? { drag, watch, veiled } : null)
  }
  const go = (number) => {
    if (number < 0) return
    remember({ [`said.${model.titles[number][2] || number}`]: {} })
    ask(model, { lesson: number })
  }

  const select = element("select", { "aria-label": "Lesson" }, element("option", { value: "-1" }, "All lessons"),
    ...model.titles.map(([title, fault], number) => {
      const option = element("option", { value: String(number) }, `${number + 1}. ${title}`)
      option.disabled = fault !== ""
      return option
    }))
  select.addEventListener("change", () => {
    const number = Number(select.value)
    if (number < 0) list()
    else if (listed && began() && number === model.lesson.number) show()
    else go(number)
  })
  const projector = button("Projector", () => announce("projector", !root.hasAttribute("data-projector")),
    { class: "projector", title: "Large type and fewer controls, for a projector" })
  const show_projector = () =>
    projector.setAttribute("aria-pressed", String(root.hasAttribute("data-projector")))
  const close = button("\u00d7", () => announce("lessons"),
    { class: "close", "aria-label": "Close the lessons", title: "Close the lessons" })
  const faults = element("div", { class: "faults" },
    ...model.titles.filter(([, fault]) => fault).map(([, fault]) => element("p", {}, fault)))
  const words = element("div", { class: "words" })
  words.addEventListener("click", (event) => {
    const chosen = event.target.closest("[data-ask]")
    if (chosen) ask(model, JSON.parse(chosen.dataset.ask))
  })
  words.addEventListener("wheel", ({ deltaY }) => { words.scrollLeft += deltaY }, { passive: true })  // columns
  const back = button("Back", () => go(next_of(model.lesson.number, -1)), { class: "step back" })
  const next = button("Next lesson", () => go(next_of(model.lesson.number, 1)), { class: "step next" })
  const again = button("Begin again", () => go(model.lesson.number),
    { class: "step again", title: "Set the scene that this lesson begins with" })
  const steps = element("footer", {}, back, again, next)
  const lesson = element("section", { class: "lesson", "aria-label": "Lesson", hidden: "" },
    element("header", {}, select, projector, close), faults, words, steps)

  const fill = (...parts) => {
    words.replaceChildren(...parts)
    for (const part of [place(), words]) part?.scrollTo(0, 0)
    send_event()
    if (open) words.querySelector("h2").focus({ preventScroll: true })
  }
  // The list of all lessons, and the page for those who teach.
  const list = () => {
    listed = steps.hidden = true
    select.value = "-1"
    const entries = model.titles.map(([title, fault], number) => {
      const entry = button(title, () => go(number), { class: "entry" })
      entry.disabled = fault !== ""
      return element("li", {}, entry)
    })
    const teachers = element("details", { class: "teachers" }, element("summary", {}, "For teachers"),
      element("div", { class: "body", html: model.teachers }))
    teachers.hidden = !model.teachers
    teachers.addEventListener("toggle", () => { if (teachers.open) teachers.scrollIntoView() })
    fill(element("h2", { tabindex: "-1" }, "Lessons"),
      element("p", { class: "note" }, "Each asks a question, shows which slider to drag, and gives the "
        + "answer. Beginning one sets its scene; Undo brings yours back."),
      element("ol", { class: "entries" }, ...entries), teachers)
  }

  // A prediction: chosen or typed. Until then the figures that would answer it are veiled.
  const prediction = ({ ask: question, choose: choices, right, unit, within }, reveal) => {
    const verdict = element("p", { class: "verdict", role: "status" })
    const boxes = choices.map((_, index) =>
      element("input", { type: "radio", name: "prediction", value: String(index) }))
    const best = boxes.length ? right - 1 : right  // choices are counted from 1
    const box = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": question })
    const settle = (given) => {
      const is_right = boxes.length ? given === best : Math.abs(given - best) <= within
      const said = (answer) => boxes.length ? `“${choices[answer]}”` : `${answer} ${unit}`.trim().replace("-", "−")
      form.dataset.said = hides ? "" : is_right ? "right" : "other"
      verdict.textContent = hides ? `Noted: ${said(given)}.` : is_right ? `Right: ${said(given)}.` : `Not quite: ${said(given)}. The answer is ${said(best)}.`
      reveal.textContent = reveal.dataset.after
      remember_answer({ given })
      announce("predicted")
    }
    boxes.forEach((one, index) => one.addEventListener("change", () => settle(index)))
    const form = element("form", { class: "prediction" }, element("h3", {}, "Your prediction"),
      element("p", {}, question),
      ...boxes.map((one, index) => element("label", {}, one, element("span", {}, choices[index]))),
      ...(boxes.length ? [] : [element("label", { class: "typed" }, box, element("span", {}, unit),
        element("button", { type: "submit" }, "Predict"))]), verdict)
    form.addEventListener("submit", (event) => {
      event.preventDefault()
      const text = box.value.trim().replace("−", "-").replace(",", ".")
      if (text && isFinite(text)) settle(Number(text))
      else verdict.textContent = "Type a number."
    })
    const { given } = answers()
    if (boxes[given]) boxes[given].checked = true
    else if (!boxes.length && Number.isFinite(given)) box.value = String(given)
    else return form
    settle(given)
    return form
  }
  // The last part of a lesson: its answer, behind a button.
  const answer = (part, heading, predict) => {
    const what = heading.toLowerCase()
    const reveal = button(predict ? `Skip to the ${what}` : heading, () => {
      uncover()
      part.setAttribute("tabindex", "-1")
      part.focus({ preventScroll: true })
      part.scrollIntoView({ inline: "start" })
    }, { class: "reveal", "aria-expanded": "false", "data-after": `Show the ${what}` })
    const uncover = () => {
      part.hidden = false
      reveal.hidden = true
      remember_answer({ revealed: true })
      announce("predicted")
    }
    part.classList.add("answer")
    part.hidden = true
    if (resumed && answers().revealed) uncover()
    return [predict ? [prediction(predict, reveal)] : [], element("div", { class: "last" }, ...(hides ? [] : [reveal, part]))]
  }
  const show = () => {
    if (!began()) return
    listed = steps.hidden = false
    const { number, title, parts, predict } = model.lesson
    remember({ last: number })
    select.value = String(number)
    back.disabled = next_of(number, -1) < 0
    next.disabled = next_of(number, 1) < 0
    const made = parts.map(({ heading, html }) =>
      element("div", { class: "part" }, element("h3", {}, heading), element("div", { class: "body", html })))
    const [predicted, last] = answer(made.pop(), parts.at(-1).heading, predict)
    fill(element("h2", { tabindex: "-1" }, title), ...made.slice(0, 1), ...predicted, ...made.slice(1), last)
    resumed = false
  }

  let scrolled = 0
  const set_open = (wanted) => {
    if (open) scrolled = place()?.scrollTop ?? 0
    open = wanted
    lesson.hidden = !open
  }
  const toggle = () => {
    set_open(!open)
    const { last } = remembered()
    if (!open) {
      if (began()) ask(model, { lesson: "" })
    } else if (began()) {  // back to where one was
      ask(model, { lesson: model.lesson.number, words_only: true })
      requestAnimationFrame(() => place()?.scrollTo(0, scrolled))
    } else if (Number.isInteger(last) && usable(last)) {
      resumed = true
      ask(model, { lesson: last, words_only: true })
    } else return list()
    send_event()
    if (open) words.querySelector("h2")?.focus({ preventScroll: true })
  }
  on_event("projector", lesson, show_projector)
  on_event("lessons", lesson, (which) => {
    const number = model.titles.findIndex(([, , name]) => name && name === which?.name)
    if (number >= 0) {  // Back came to it: its words, and the scene as it is
      resumed = true
      set_open(true)
      ask(model, { lesson: number, words_only: true })
      return send_event()
    }
    if (which !== "first") return !which || open ? toggle() : undefined
    set_open(true)
    go(next_of(-1, 1))
    send_event()
  })
  show_projector()
  model.on("lesson", show)
  if (model.open_first && began()) {
    set_open(true)
    requestAnimationFrame(show)
  }
  return lesson
}
