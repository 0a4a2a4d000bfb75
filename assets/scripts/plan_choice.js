// The plan: a button beside the status line; above it what was planned, and choices by hand.
export function render({ model }) {
  const back = element("button", {
    type: "button", class: "own", title: "Back to the program's own choices",
  }, "Automatic again")
  const more = element("button", {
    type: "button", class: "more", "aria-expanded": "false", "aria-controls": "plan-list",
  }, "Plan")
  const plans = element("div", { class: "plans" })
  const selects = {}
  const fields = model.spec.choices.map(({ name, label, options }) => {
    const select = selects[name] = element("select", { id: `plan-${name}` },
      ...options.map(([value, words]) => element("option", { value }, words)))
    select.addEventListener("change", () => model.send_msg({ [name]: select.value }))
    return element("div", { class: "field" }, element("label", { for: select.id }, label), select)
  })
  const about = element("p", { class: "about" },
    "While a slider moves, all is drawn at once with the usual settings. When it rests, the " +
    "program plans how to compute what is on screen, no finer than the allowed error asks for, and draws it anew.")
  const wait = element("p", { class: "about" },
    "On this first start the program is still being compiled for motions; until then they are " +
    "drawn as usual.")
  const list = element("section", { id: "plan-list", class: "list", "aria-label": "Plan" },
    about, wait, plans, element("div", { class: "fields" }, ...fields))
  list.hidden = true
  const box = element("div", { class: "box" }, back, more, list)

  const open = (shown) => {
    list.hidden = !shown
    more.setAttribute("aria-expanded", String(shown))
    more.title = shown ? "Hide the plan" : "Show the plan, and overrule it"
  }
  more.addEventListener("click", () => open(list.hidden))
  back.addEventListener("click", () => {
    model.send_msg({ own: true })
    more.focus()
  })
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !list.hidden) {
      open(false)
      more.focus()
    }
  })
  const write = () => {
    const { tab, plans: made, resting, compiling, chosen, by_hand } = model.state
    window.__resting = resting  // for tests and benchmarks, as is the mark of the packed source
    window.__tab = tab
    wait.hidden = !compiling
    back.hidden = by_hand.length === 0
    more.dataset.overruled = String(by_hand.length > 0)
    if (made.length || resting) plans.replaceChildren(...made.length
      ? made.map(([title, sentence]) => element("p", {}, element("strong", {}, title), ` ${sentence}.`))
      : [element("p", {}, compiling ? "" : "Nothing here has a plan: what is on screen is drawn as usual.")])
    plans.dataset.stale = String(!resting)
    for (const [name, value] of Object.entries(chosen)) {
      const options = [...selects[name].options]
      if (!options.some((option) => option.value === value))  // set elsewhere
        selects[name].add(new Option(`${value} Hz`, value))
      if (selects[name].value !== value) selects[name].value = value
    }
  }
  model.on("state", write)
  open(false)
  write()
  return box
}
