// The lessons beside the figures: a list of them, the words of one, its prediction and its answer.
// Words come from the server as HTML that is safe whoever wrote it; a button in them carries what it
// asks for in data-ask. A scene is set when a lesson is begun, and never when its words come back.
//
// Other scripts hear of it by the event "explorer-lesson" on the window: which controls it speaks
// of and which figures it marks, or null where none is open. "explorer-lessons" opens and closes.

const REMEMBERED = "bearing-explorer.lessons"

// What this tab of the browser remembers: the last lesson, and what was answered in each.
function remembered() {
  try {
    const found = JSON.parse(sessionStorage.getItem(REMEMBERED) ?? "{}")
    return found !== null && typeof found === "object" && !Array.isArray(found) ? found : {}
  } catch {
    return {}
  }
}
function remember(changes) {
  try {
    sessionStorage.setItem(REMEMBERED, JSON.stringify({ ...remembered(), ...changes }))
  } catch { /* for as long as the page stands */ }
}

export function render({ model }) {
  let open = false
  const count = model.titles.length
  const usable = (number) => number >= 0 && number < count && !model.titles[number][1]
  const next_of = (number, step) => {
    let at = number + step
    while (at >= 0 && at < count && !usable(at)) at += step
    return usable(at) ? at : -1
  }
  const began = () => model.lesson.title !== undefined
  const key = () => `said.${model.lesson.name || model.lesson.number}`

  const select = element("select", { id: "lesson-choice", "aria-label": "Lesson" },
    element("option", { value: "-1" }, "All lessons"))
  model.titles.forEach(([title, fault], number) => {
    const option = element("option", { value: String(number) }, `${number + 1}. ${title}`)
    option.disabled = fault !== ""
    select.append(option)
  })
  const projector = element("button", { type: "button", class: "projector", "aria-pressed": "false",
    title: "Large type and fewer controls, for a projector" }, "Projector")
  const close = element("button", { type: "button", class: "close", "aria-label": "Close the lessons",
    title: "Close the lessons" }, "\u00d7")
  const faults = element("div", { class: "faults" }, ...model.titles.filter(([, fault]) => fault)
    .map(([, fault]) => element("p", {}, fault)))
  const words = element("div", { class: "words" })
  const back = element("button", { type: "button", class: "step back" }, "Back")
  const next = element("button", { type: "button", class: "step next" }, "Next lesson")
  const again = element("button", { type: "button", class: "step again",
    title: "Set the scene that this lesson begins with" }, "Begin again")
  const steps = element("footer", {}, back, again, next)
  const lesson = element("section", { class: "lesson", "aria-label": "Lesson", hidden: "" },
    element("header", {}, select, projector, close), faults, words, steps)
  const place = () => lesson.getRootNode().host?.closest(".lesson-place")

  let listed = false  // whether the list is shown instead of a lesson
  const say = () => {
    const { drag = [], watch = [] } = began() && !listed ? model.lesson : {}
    const shown = open ? { drag, watch } : null
    document.documentElement.toggleAttribute("data-lesson", open)
    window.__lesson = shown
    window.dispatchEvent(new CustomEvent("explorer-lesson", { detail: shown }))
  }

  // The list of all lessons, and the page for those who teach.
  const list = () => {
    listed = true
    select.value = "-1"
    steps.hidden = true
    const entries = model.titles.map(([title, fault], number) => {
      const button = element("button", { type: "button", class: "entry" }, title)
      button.disabled = fault !== ""
      button.addEventListener("click", () => go(number))
      return element("li", {}, button)
    })
    const teachers = element("details", { class: "teachers" },
      element("summary", {}, "For teachers"), element("div", { class: "body" }))
    teachers.hidden = !model.teachers
    teachers.lastChild.innerHTML = model.teachers
    teachers.addEventListener("toggle", () => {
      if (teachers.open) teachers.scrollIntoView({ block: "start" })
    })
    words.replaceChildren(
      element("h2", { tabindex: "-1" }, "Lessons"),
      element("p", { class: "note" }, "Each asks a question, shows what to drag, and answers. "
        + "Beginning one sets its scene; Undo brings yours back."),
      element("ol", { class: "entries" }, ...entries), teachers)
    place()?.scrollTo(0, 0)
    say()
    if (open) words.querySelector("h2").focus({ preventScroll: true })
  }

  // A prediction: chosen or typed, before the answer is seen.
  const prediction = ({ ask: question, choices, right, unit, within }, reveal) => {
    const verdict = element("p", { class: "verdict", role: "status" })
    const form = element("form", { class: "prediction" }, element("h3", {}, "Your prediction"),
      element("p", {}, question))
    const settled = (given, is_right, said) => {
      form.dataset.said = is_right ? "right" : "other"
      verdict.textContent = `You said ${said}: ${is_right ? "right." : "it turns out differently."} `
      reveal.textContent = reveal.dataset.after
      remember({ [key()]: { ...remembered()[key()], given } })
    }
    if (choices.length) {
      const boxes = choices.map((text, index) => {
        const box = element("input", { type: "radio", name: "prediction", value: String(index) })
        box.addEventListener("change", () => settled(index, index === right, `“${text}”`))
        return element("label", {}, box, element("span", {}, text))
      })
      form.append(...boxes)
    } else {
      const box = element("input", { type: "text", inputmode: "decimal", autocomplete: "off",
        "aria-label": question })
      const done = element("button", { type: "submit" }, "Predict")
      form.append(element("label", { class: "typed" }, box, element("span", {}, unit), done))
    }
    form.addEventListener("submit", (event) => {
      event.preventDefault()
      const box = form.querySelector("input[type=text]")
      if (!box) return
      const text = box.value.trim().replace("\u2212", "-").replace(",", ".")
      const given = Number(text)
      if (!text || !Number.isFinite(given)) {
        verdict.textContent = "Type a number."
        return
      }
      settled(given, Math.abs(given - right) <= within, `${box.value.trim()} ${unit}`.trim())
    })
    form.append(verdict)
    const { given } = remembered()[key()] ?? {}
    if (given !== undefined) {
      const boxes = form.querySelectorAll("input[type=radio]")
      if (boxes.length && boxes[given]) {
        boxes[given].checked = true
        settled(given, given === right, `“${choices[given]}”`)
      } else if (!boxes.length && Number.isFinite(given)) {
        form.querySelector("input").value = String(given)
        settled(given, Math.abs(given - right) <= within, `${given} ${unit}`.trim())
      }
    }
    return form
  }

  const show = () => {
    if (!began()) return
    listed = false
    const { number, title, parts, predict } = model.lesson
    remember({ last: number })
    select.value = String(number)
    steps.hidden = false
    const heading = element("h2", { tabindex: "-1" }, title)
    const blocks = parts.map(({ heading, html }, index) => {
      const body = element("div", { class: "body" })
      body.innerHTML = html
      const last = index === parts.length - 1
      const part = element("div", { class: last ? "part answer" : "part" }, element("h3", {}, heading), body)
      if (!last) return part
      part.hidden = true
      const reveal = element("button", { type: "button", class: "reveal", "aria-expanded": "false" },
        predict ? `Skip to the ${heading.toLowerCase()}` : heading)
      reveal.dataset.after = `Show the ${heading.toLowerCase()}`
      const uncover = (moving) => {
        part.hidden = false
        reveal.hidden = true
        remember({ [key()]: { ...remembered()[key()], revealed: true } })
        if (!moving) return
        part.setAttribute("tabindex", "-1")
        part.focus({ preventScroll: true })
        part.scrollIntoView({ block: "start" })
      }
      reveal.addEventListener("click", () => uncover(true))
      const box = element("div", { class: "last" })
      if (predict) box.append(prediction(predict, reveal))
      box.append(reveal, part)
      if (remembered()[key()]?.revealed && resumed) uncover(false)
      return box
    })
    words.replaceChildren(heading, ...blocks)
    place()?.scrollTo(0, 0)
    back.disabled = next_of(number, -1) < 0
    next.disabled = next_of(number, 1) < 0
    say()
    if (open) heading.focus({ preventScroll: true })
    resumed = false
  }
  // Whether the lesson that comes was open before: then what was answered in it is shown again.
  let resumed = model.open_first
  const go = (number) => {
    if (number < 0) return
    remember({ [`said.${model.titles[number][2] || number}`]: {} })
    ask(model, { lesson: number })
  }
  let scrolled = 0
  const toggle = (wanted = !open) => {
    if (open === wanted) return
    if (open) scrolled = place()?.scrollTop ?? 0
    open = wanted
    lesson.hidden = !open
    if (!open) {
      if (began()) ask(model, { lesson: "" })
      say()
      return
    }
    const { last } = remembered()
    if (began()) {  // back to where one was
      ask(model, { lesson: model.lesson.number, words_only: true })
      say()
      requestAnimationFrame(() => place()?.scrollTo(0, scrolled))
    } else if (Number.isInteger(last) && usable(last)) {
      resumed = true
      ask(model, { lesson: last, words_only: true })
      say()
    } else list()
    words.querySelector("h2")?.focus({ preventScroll: true })
  }

  words.addEventListener("click", (event) => {
    const button = event.target.closest("[data-ask]")
    if (button) ask(model, JSON.parse(button.dataset.ask))
  })
  select.addEventListener("change", () => {
    if (select.value === "-1") list()
    else if (listed && began() && Number(select.value) === model.lesson.number) show()
    else go(Number(select.value))
  })
  const show_projector = () => {
    projector.setAttribute("aria-pressed", String(window.explorer_projector.on))
  }
  projector.addEventListener("click", () => window.explorer_projector.turn())
  window.addEventListener("explorer-projector", show_projector)
  close.addEventListener("click", () => window.dispatchEvent(new CustomEvent("explorer-lessons")))
  back.addEventListener("click", () => go(next_of(model.lesson.number, -1)))
  next.addEventListener("click", () => go(next_of(model.lesson.number, 1)))
  again.addEventListener("click", () => go(model.lesson.number))
  const heard = (event) => {
    if (lesson.isConnected && event.detail === "first") {  // somebody asked to begin
      open = true
      lesson.hidden = false
      go(next_of(-1, 1))
      say()
    } else if (lesson.isConnected) toggle()
    else window.removeEventListener("explorer-lessons", heard)
  }
  window.addEventListener("explorer-lessons", heard)
  model.on("lesson", show)
  if (model.open_first && began()) {
    open = true
    lesson.hidden = false
    requestAnimationFrame(() => {
      show()
      show_projector()
    })
  }
  return lesson
}
