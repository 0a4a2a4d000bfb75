// The lessons beside the figures: a list of them, the words of one, its prediction and its answer.
// Words come from the server as safe HTML; a button in them carries its message in data-ask. A scene
// is set when a lesson begins, and never when its words are shown again. A lesson comes in steps: its
// question with the prediction, which has the side panel alone, then each of its other parts. They are
// below one another, and one at a time on a projector, where a row of buttons leads to each.
//
// Other scripts get the event "lesson": which controls it names, which figures it marks and which it
// veils, or null where none is open. The event "lessons" opens and closes them.

const REMEMBERED = "bearing-explorer.lessons"

// What this tab of the browser remembers: the answers given in each lesson.
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

// Whether a teacher's link has asked this browser to keep answers back, at most so long ago.
const HIDES = "bearing-explorer.hides-answers", HIDDEN_FOR = 12 * 3600 * 1000  // ms
function hides_answers() {
  const asked = location.hash.includes("hide-answers")
  try {
    if (asked) localStorage.setItem(HIDES, String(Date.now()))
    return Date.now() - Number(localStorage.getItem(HIDES) ?? -Infinity) < HIDDEN_FOR
  } catch {
    return asked
  }
}

export function render({ model }) {
  const root = document.documentElement
  const next_of = (number, step) => {
    for (let at = number + step; at in model.titles; at += step) if (model.titles[at][1] === "") return at
    return -1
  }
  const began = () => model.lesson.title !== undefined
  const place = () => lesson.getRootNode().host?.closest(".lesson-place")
  const key = () => `said.${model.lesson.name || model.lesson.number}`
  const answers = () => Object(remembered()[key()])
  const show_result = () => { if (Object.keys(model.lesson.result).length) ask(model, model.lesson.result) }
  const remember_answer = (answer) => remember({ [key()]: { ...answers(), ...answer } })

  const hides = hides_answers()

  let open = false, listed = false  // whether the list is shown instead of a lesson
  let resumed = model.open_first  // whether the lesson that comes was open before, with its answers
  let asks = false, reads = false  // whether its question has the side panel alone, or its answer is read
  const send_event = () => {
    const { drag = [], watch = [], predict } = began() && !listed ? model.lesson : {}
    const { given, tried } = answers()
    const veiled = predict && given === undefined && !tried ? predict.veil ?? watch : []
    root.toggleAttribute("data-lesson", open)
    root.dataset.cell = (open && !listed && model.lesson.cell) || ""
    root.toggleAttribute("data-asks", lesson.classList.toggle("asks", open && !listed && asks))
    root.toggleAttribute("data-reads", lesson.classList.toggle("reads", open && (listed || reads)))
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
    else go(number)
  })
  const projector = button("Projector", () => announce("projector", !root.hasAttribute("data-projector")),
    { class: "projector", "aria-label": "Projector", title: "Large type and fewer controls, for a projector" })
  const show_projector = () => {
    const large = root.hasAttribute("data-projector")
    projector.setAttribute("aria-pressed", String(large))
    lesson.classList.toggle("large", large)
    back.textContent = large ? "\u2039" : "Back"  // there the list of lessons needs the room
    next.textContent = large ? "\u203a" : "Next lesson"
    projector.textContent = large ? "\u2922" : "Projector"
  }
  const close = button("\u00d7", () => announce("lessons"),
    { class: "close", "aria-label": "Close the lessons", title: "Close the lessons" })
  const faults = element("div", { class: "faults" },
    ...model.titles.filter(([, fault]) => fault).map(([, fault]) => element("p", {}, fault)))
  const words = element("div", { class: "words" })
  words.addEventListener("click", (event) => {
    const chosen = event.target.closest("[data-ask]")
    if (chosen) ask(model, JSON.parse(chosen.dataset.ask))
  })
  const back = button("", () => go(next_of(model.lesson.number, -1)), { class: "step back", "aria-label": "Back" })
  const next = button("", () => go(next_of(model.lesson.number, 1)), { class: "step next", "aria-label": "Next lesson" })
  const again = button("Begin again", () => go(model.lesson.number),
    { class: "step again", title: "Set the scene that this lesson begins with" })
  const steps = element("footer", {}, back, again, next)
  const parts = element("div", { class: "parts", role: "group", "aria-label": "Parts of the lesson" })
  const lesson = element("section", { class: "lesson", "aria-label": "Lesson", hidden: "" },
    element("header", {}, select, parts, projector, close), faults, words, steps)

  const fill = (...parts) => {
    words.replaceChildren(...parts)
    for (const part of [place(), words]) part?.scrollTo(0, 0)
    send_event()
    if (open) words.querySelector("h2").focus({ preventScroll: true })
  }
  // The list of all lessons.
  const list = () => {
    listed = steps.hidden = parts.hidden = true
    select.value = "-1"
    const entries = model.titles.map(([title, fault], number) => {
      const entry = button(title, () => go(number), { class: "entry" })
      entry.disabled = fault !== ""
      return element("li", {}, entry)
    })
    fill(element("h2", { tabindex: "-1" }, "Lessons"),
      element("p", { class: "note" }, "Each asks a question, shows which slider to drag, and gives the "
        + "answer. Beginning one sets its scene; Undo brings yours back."),
      element("ol", { class: "entries" }, ...entries))
  }

  // A prediction: chosen or typed. Until then the figures that would answer it are veiled.
  // A first wrong one gets the lesson's hint and another try.
  const prediction = ({ ask: question, choose: choices, right, unit, within, hint }, settled) => {
    let helps = hint && !hides && answers().given === undefined
    const verdict = element("p", { class: "verdict", role: "status" })
    const boxes = choices.map((_, index) =>
      element("input", { type: "radio", name: "prediction", value: String(index) }))
    const best = boxes.length ? right - 1 : right  // choices are counted from 1
    const box = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": question })
    const settle = (given, anew = true) => {
      const is_right = boxes.length ? given === best : Math.abs(given - best) <= within
      const said = (answer) => boxes.length ? `“${choices[answer]}”` : `${answer} ${unit}`.trim().replace("-", "−")
      if (helps && !is_right) {
        const off = boxes.length ? "" : `: ${said(given)} is too ${given < best ? "low" : "high"}`
        helps = false
        form.dataset.said = "again"
        verdict.textContent = `Not quite${off}. ${hint} Try once more.`
        return
      }
      form.dataset.said = hides ? "" : is_right ? "right" : "other"
      verdict.textContent = hides ? `Noted: ${said(given)}.` : is_right ? `Right: ${said(best)}${given === best ? "" : `, and ${said(given)} is near enough`}.` : `Not quite: ${said(given)}. The answer is ${said(best)}.`
      remember_answer({ given })
      settled()
      announce("predicted")
      if (anew) show_result()
    }
    boxes.forEach((one, index) => {
      one.addEventListener("change", () => settle(index))
      one.addEventListener("keydown", (event) => {  // an arrow goes to a choice, and does not make it
        const by = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key]
        if (by || event.key === "Enter") event.preventDefault()
        if (by) boxes.at((index + by) % boxes.length).focus()
        else if (event.key === "Enter") one.click()
      })
    })
    const form = element("form", { class: "prediction" }, element("h3", {}, "Your prediction"),
      element("p", { class: "asked" }, question),
      element("div", { class: "choices" },
        ...boxes.map((one, index) => element("label", {}, one, element("span", {}, choices[index]))),
        ...(boxes.length ? [] : [element("label", { class: "typed" }, box, element("span", {}, unit),
          element("button", { type: "submit" }, "Predict"))])), verdict)
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
    settle(given, false)
    return form
  }
  const show = () => {
    if (!began()) return
    listed = steps.hidden = parts.hidden = false
    const { number, title, parts: written, predict } = model.lesson
    const { revealed, tried } = resumed ? answers() : {}
    select.value = String(number)
    back.disabled = next_of(number, -1) < 0
    next.disabled = next_of(number, 1) < 0
    const made = written.map(({ heading, html }) => element("div", { class: "part", tabindex: "-1" },
      element("h3", {}, heading), element("div", { class: "body", html })))
    const [question, answer] = [made[0], made.at(-1)]
    if (hides) made.pop()
    const named = written.slice(0, made.length).map(({ heading }) => heading)
    answer.classList.add("answer")
    answer.hidden = !revealed
    asks = Boolean(predict) && !tried
    reads = false
    // To a part: those before the answer come with the controls, and the answer is uncovered.
    const go_on = (at) => {
      if (asks && made[at] === answer && answers().given === undefined) show_result()
      asks &&= at === 0
      reads = made[at] === answer
      if (reads) answer.hidden = false
      if (at !== 0) remember_answer({ tried: true, ...(answer.hidden ? {} : { revealed: true }) })
      show_part(Math.max(at, 0))
      send_event()
      made[at]?.focus({ preventScroll: true })
      made[at]?.scrollIntoView({ block: "start" })
    }
    const show_part = (current) => {
      made.forEach((part, at) => {
        if (part !== answer) part.hidden = asks && at > 0
        part.classList.toggle("current", at === current)
      })
      parts.replaceChildren(...named.map((name, at) =>
        button(name, () => go_on(at), { "aria-pressed": String(at === current) })))
      on.hidden = !asks || answers().given === undefined
      reveal.hidden = hides || !answer.hidden
      reveal.textContent = `${asks && on.hidden ? "Skip to the" : "Show the"} ${written.at(-1).heading.toLowerCase()}`
    }
    const on = button("Try it yourself", () => go_on(made[1] === answer ? -1 : 1), { class: "reveal" })
    const reveal = button("", () => go_on(made.length - 1), { class: "reveal second", "aria-expanded": "false" })
    if (predict) question.append(prediction(predict, () => show_part(0)))
    show_part(0)
    fill(element("h2", { tabindex: "-1" }, title), ...made.filter((part) => part !== answer),
      element("div", { class: "ways" }, on, reveal), ...(hides ? [] : [answer]))
    resumed = false
  }

  const set_open = (wanted) => {
    open = wanted
    lesson.hidden = !open
  }
  const toggle = () => {
    set_open(!open)
    if (open) return list()  // the scene may be another than that of the lesson before
    if (began()) ask(model, { lesson: "" })
    send_event()
  }
  on_event("projector", lesson, show_projector)
  on_event("lessons", lesson, (which) => {
    const number = model.titles.findIndex(([, , name]) => name && name === which?.name)
    if (number >= 0) {  // Back came to it from another, with its scene, or from none: its words
      const other = began() && number !== model.lesson.number
      resumed = true
      set_open(true)
      ask(model, { lesson: number, ...(other ? {} : { words_only: true }) })
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
