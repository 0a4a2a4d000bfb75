// What all panels of controls share: sliders with numbers to type into, and choices.
//
// A drag is sent at once, but never more than two changes ahead of what is drawn (`window.__mark` is
// the number of the newest change drawn): a slow server gets fewer changes, and always the newest
// position. The server checks everything; a refusal comes back as a sentence for its control.
//
// The second change on the way bridges the network and the repaint. On a server that many share,
// changes queue behind those of others. Then one at a time is sent, and held here for a part of that
// time, while it can still be replaced by a newer position: as many pictures come, each more recent.

const AHEAD = 2           // changes that may be on their way
const PATIENCE = 400      // ms until a change counts as lost
const CROWDED = 80        // ms of waiting; repaints take less, the rest is for others
const HELD = 0.6          // the part of them to be waited here ...
const LONGEST_HELD = 150  // ms ... and no longer

const format = (value, step) => {
  if (value === null) return ""
  const digits = Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)))
  // A typed number keeps its own digits, a dragged one those of the step.
  const short = Number(value.toFixed(digits))
  const own = String(value).length > 10 ? Number(value.toPrecision(7)) : value  // of another unit
  return String(Math.abs(short - value) <= 1e-9 * Math.abs(value) ? short : own)
    .replace("-", "\u2212")
}

// Meaning, unit and range of a quantity, as a tooltip.
const tip = ({ about, unit, limit: { least, most } }) => {
  const in_unit = unit === "\u00b0" || unit === "" ? unit : `\u00a0${unit}`
  const kind = unit ? `In ${unit === "\u00b0" ? "degrees (\u00b0)" : unit}` : "A number"
  return `${about}\n${kind}; the slider goes from ${least} to ${most}${in_unit}.`.replace(/-(?=\d)/g, "\u2212")
}

// The number that is typed in a box: NaN for none.
const number_in = ({ value }) => value.trim() ? Number(value.replace("\u2212", "-").replace(",", ".")) : NaN

// Boxes are as wide as their numbers, so that "−100000" is not cut.
const WIDEST = 13  // digits
function write_in(input, text) {
  if (input.value === text) return
  input.value = text
  fit(input)
}
function number_box(attributes) {
  const box = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", ...attributes })
  box.addEventListener("input", () => fit(box))
  box.addEventListener("focus", () => box.select())
  return box
}
function fit(input) {
  const count = Math.min(input.value.length, WIDEST)
  input.style.width = count > 5 ? `calc(${count}ch + 16px)` : ""
}

// Rows of one panel. `changed` hears of every change of a value, `touched` of the control in use.
function make_rows(model, { changed = () => {}, touched = () => {} } = {}) {
  const rows = {}, selects = {}
  let limits = {}, values = {}, second_units = {}
  let pending = null, sent_at = 0, waiting = false
  let released = false, held = false, in_hand = false

  const on_way = new Map()  // when changes were sent
  let network = Infinity, held_back = 0, answered = 0

  const drawn = () => window.__mark || 0
  const asked = () => window.__asked || 0
  const send = (message) => {
    ask(model, message)
    sent_at = performance.now()
    on_way.set(asked(), sent_at)
  }
  // How long the newest picture's change queued decides how the next is sent.
  const learn = () => {
    let way = -Infinity
    for (const [mark, began] of on_way) {
      if (mark > drawn()) break
      way = Math.max(way, window.__arrived - began)
      on_way.delete(mark)
    }
    if (way < 0) return
    answered = window.__arrived
    const elsewhere = Math.max(0, way - 1000 * window.__worked)
    network = Math.min(network, elsewhere)
    const waited = held_back + elsewhere - network
    held_back = waited > CROWDED ? Math.min(HELD * waited, LONGEST_HELD) : 0
  }
  const may_send = () => {
    learn()
    return asked() - drawn() < (held_back ? 1 : AHEAD)
      && performance.now() >= answered + held_back
  }
  const late = () => performance.now() - sent_at > PATIENCE
  const pump = () => {
    waiting = false
    if (pending === null) return
    if (!may_send() && !late()) {
      waiting = true
      requestAnimationFrame(pump)
      return
    }
    send_now()
  }
  const send_now = () => {
    const message = released ? { set: pending, released } : { set: pending }
    pending = null
    released = false
    window.__waiting?.delete(send_now)
    send(message)
  }
  // The end of a drag: it is one step to undo. A key held down is one too.
  const release = () => {
    announce("hand", in_hand = false)
    pending = { ...pending }
    released = true
    keep_waiting(send_now)
    if (!waiting) pump()
  }
  const holds = (event, on) => {
    if (!/^(Arrow|Page|Home|End)/.test(event.key)) return
    if (held && !on) release()
    held = on
  }
  const push = (name, value) => push_all({ [name]: value })
  const push_all = (set) => {
    if (!in_hand) announce("hand", in_hand = true)
    for (const name of Object.keys(set)) rows[name].asked = asked() + 1
    pending = { ...pending, ...set }
    keep_waiting(send_now)
    if (!waiting) pump()
  }

  // What a row shows of its value and limits: with the other sign where people read that ("Load,
  // downwards"). Values keep the sign of links.
  const read = (name, value) => value === null || value === undefined ? value : rows[name].sign * value || 0
  const limit_of = (name) => {
    const { least, most, step } = limits[name]
    return rows[name].sign > 0 ? limits[name] : { least: -most, most: -least, step }
  }
  const turned = (name, text) => rows[name].sign > 0 || !/^\s*[-+\u2212]?[\d.,]/.test(text) ? text
    : /^\s*[-\u2212]/.test(text) ? text.replace(/[-\u2212]/, "") : `-${text.trim().replace("+", "")}`

  const paint = (name) => {
    const row = rows[name]
    if (!limits[name]) return
    const limit = limit_of(name), value = read(name, values[name])
    const share = (v) => 100 * (v - limit.least) / (limit.most - limit.least)
    const origin = limit.least < 0 && limit.most > 0 ? 0 : limit.least
    const ends = [share(origin), share(value ?? origin)].sort((a, b) => a - b)
    row.slider.style.setProperty("--from", `${ends[0]}%`)
    row.slider.style.setProperty("--to", `${ends[1]}%`)
    row.slider.setAttribute("aria-valuetext", value === null
      ? row.number.placeholder || "no value" : `${format(value, limit.step)} ${row.unit}`)
    show_second(name)
    changed(name, values[name])
  }
  // The same number in its second unit, which can be typed too.
  const show_second = (name) => {
    const { second } = rows[name], known = second_units[name]
    second.root.hidden = !known
    if (!known || second.root.contains(second.number.getRootNode().activeElement)) return
    const value = values[name]
    if (second.unit.textContent !== known.unit || second.number.title !== known.words) {
      second.unit.textContent = known.unit
      second.number.setAttribute("aria-label", `${rows[name].label} in ${known.unit}, ${known.words}`)
      second.number.title = known.words
    }
    write_in(second.number, value === null || value === undefined ? ""
      : String(Number((value * known.factor).toPrecision(5))).replace("-", "\u2212"))
  }
  // Shows a value; `typed`: also where its number is being typed.
  const put = (name, value, typed = false) => {
    const row = rows[name]
    values[name] = value
    row.slider.value = read(name, value) ?? limit_of(name).least
    if (typed || row.root.querySelector("input:focus") !== row.number)
      write_in(row.number, format(read(name, value), limits[name].step))
    paint(name)
  }
  const refuse = (name, sentence) => {
    const row = rows[name] ?? selects[name]
    if (!row || (!sentence && row.refusal.hidden)) return
    row.refusal.textContent = sentence
    row.refusal.hidden = !sentence
    row.root.classList.toggle("refused", !!sentence)
    row.number?.setAttribute("aria-invalid", sentence ? "true" : "false")
  }
  // A text that was refused does not stay as if it were the value; its sentence does, until the
  // next change.
  const forget_refused = () => {
    for (const name of Object.keys(rows)) refuse(name, "")
  }
  const restore = (name) => {
    const row = rows[name]
    if (row && row.number.getAttribute("aria-invalid") === "true")
      write_in(row.number, format(read(name, values[name]) ?? null, limits[name].step))
  }
  const move = (name, value) => move_all({ [name]: value })
  const move_all = (set) => {
    forget_refused()
    for (const [name, value] of Object.entries(set)) {
      refuse(name, "")
      put(name, value, true)
    }
    push_all(set)
  }

  // A number is sent as typed, or with its sign `turned`: a refusal quotes the text as typed.
  let typed_text = "", sent_text = ""
  const type_in = (message, text = "") => {
    forget_refused()
    typed_text = text.trim()
    sent_text = Object.values(message.typed ?? {})[0] ?? ""
    send(message)
  }

  const control = ({ name, label, sign, symbol, unit, about }) => {
    const id = `control-${name}`
    const slider = element("input", {
      type: "range", id, "aria-describedby": `${id}-refusal ${id}-about`,
    })
    const number = number_box({ class: "number", "aria-label": `${label}${unit ? ` in ${unit}` : ""}, type a number` })
    const refusal = element("p", { class: "refusal", role: "alert", id: `${id}-refusal`, hidden: "" })
    const extra = element("span", { class: "extra" })
    // Its meaning is a tooltip, and a note after a click on its symbol.
    const help = element("button", {
      type: "button", class: "symbol", html: symbol || "?",
      "aria-controls": `${id}-about`, "aria-label": `About ${label.toLowerCase()}`,
    })
    const title = element("label", { for: id }, label)
    const head = element("div", { class: "head" },
      element("span", { class: "named" }, title, help), extra,
      element("span", { class: "entry" }, number, element("span", { class: "unit" }, unit)))
    const second = { number: number_box({ class: "second" }), unit: element("span", { class: "unit" }) }
    second.root = element("span", { class: "entry twin", hidden: "" }, second.number, second.unit)
    const line = element("div", { class: "line" }, slider, second.root)
    const words = element("p", { class: "note", id: `${id}-about` }, about)
    const root = element("div", { class: `control control-${name}`, "data-name": name },
      head, line, refusal, words)
    unfolds(help, words)
    rows[name] = { asked: 0, sign, root, named: head.firstChild, slider, number, refusal, extra, unit, line, about, label, symbol, second }

    slider.addEventListener("input", () => move(name, read(name, Number(slider.value))))
    slider.addEventListener("change", () => { if (!held) release() })
    for (const input of [slider, number]) {
      input.addEventListener("keydown", (event) => holds(event, true))
      input.addEventListener("keyup", (event) => holds(event, false))
      input.addEventListener("blur", () => { if (held) holds({ key: "End" }, false) })
    }
    number.addEventListener("change", () => type_in({ typed: { [name]: turned(name, number.value) } }, number.value))
    number.addEventListener("blur", () => restore(name))
    number.addEventListener("input", () => {  // what is typed back is no error any more
      const { least, most } = limit_of(name), given = number_in(number)
      if (given >= least && given <= most) refuse(name, "")
    })
    second.number.addEventListener("blur", () => show_second(name))
    second.number.addEventListener("change", () => type_in({ second: { [name]: second.number.value } }))
    number.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        refuse(name, "")
        write_in(number, format(read(name, values[name]), limits[name].step))
      } else if (/^(Arrow|Page)(Up|Down)$/.test(event.key)) {
        event.preventDefault()
        const { least, most, step } = limit_of(name)
        const far = (event.key.startsWith("Page") ? 10 : 1) * step
        const moved = (read(name, values[name]) ?? least) + (event.key.endsWith("Up") ? far : -far)
        move(name, read(name, Number(Math.min(most, Math.max(least, moved)).toPrecision(12))))
      }
    })
    root.addEventListener("focusin", () => touched(name))
    root.addEventListener("pointerenter", () => touched(name))
    return root
  }

  // A choice out of a list, with its note behind a question mark.
  const choice = (name, ...extra) => {
    const { label, options } = model.spec.choices[name]
    const select = element("select", { id: `choice-${name}` })
    const note = element("p", { class: "note", id: `note-${name}` })
    for (const option of options)
      select.append(element("option", { value: option.value, title: option.about }, option.label))
    select.addEventListener("change", () => {
      forget_refused()
      send({ choose: { [name]: select.value } })
    })
    const more = element("button", {
      type: "button", class: "info", "aria-controls": `note-${name}`,
      "aria-label": `About ${label.toLowerCase()}`, title: "About this choice",
    }, "?")
    const open = unfolds(more, note)
    const refusal = element("p", { class: "refusal", role: "alert", hidden: "" })
    const title = element("label", { for: `choice-${name}` }, label)
    const root = element("div", { class: `choice choice-${name}` }, ...(model.spec.choices[name].group
      ? [element("div", { class: "head" }, title, select, more)]
      : [element("div", { class: "head" }, title, ...extra, more), select]), refusal, note)
    // `effect`: what the choice has just done, if that is not plain from what it is
    selects[name] = { refusal, root, select, show: (value, effect = "") => {
      select.value = value
      note.textContent = [effect, options.find((option) => option.value === value)?.about].filter(Boolean).join(" ")
      if (effect) open(true)
    } }
    return root
  }

  // Shows a state of the server; values and choices that this panel does not have are passed over.
  const take = (state) => {
    Object.assign(second_units, state.second_units ?? {})
    for (const [name, limit] of Object.entries(state.limits ?? {})) {
      if (!rows[name]) continue
      limits[name] = limit
      const { least, most, step } = limit_of(name)
      Object.assign(rows[name].slider, { min: least, max: most, step })
      rows[name].named.title = tip({ ...rows[name], limit: { least, most } })
      if (values[name] !== undefined) put(name, values[name])
    }
    for (const [name, value] of Object.entries(state.values ?? {})) {
      if (!rows[name] || !limits[name]) continue
      if (rows[name].asked > state.mark) continue  // moved since
      refuse(name, "")
      put(name, value, true)
    }
    for (const [name, value] of Object.entries(state.choices ?? {})) {
      if (!selects[name]) continue
      refuse(name, "")
      selects[name].show(value, state.effects?.[name])
    }
    if (state.second_units) for (const name of Object.keys(rows)) show_second(name)
    if (state.hidden)
      for (const [name, { root }] of [...Object.entries(rows), ...Object.entries(selects)])
        root.hidden = state.hidden.includes(name)
  }

  const listen = (takes = take) => model.on("msg:custom", (message) => {
    if (message.state) takes(message.state)
    for (const [name, sentence] of Object.entries(message.refused ?? {})) {
      refuse(name, sentence.replace(`“${sent_text}”`, `“${typed_text}”`))
      if (rows[name]?.root.querySelector("input:focus") !== rows[name]?.number) restore(name)
    }
  })

  // The controls and choices of a group in a box; those named `last` at its end.
  const group_box = ({ title, controls }, last = []) => {
    const own = Object.entries(model.spec.choices).filter(([, { group }]) => group === title)
    const chosen = (first) => own.filter(([, one]) => Boolean(one.first) === first).map(([name]) => choice(name))
    const behind = ({ name }) => last.includes(name)
    return element("fieldset", { "data-group": title }, element("legend", {}, title), ...chosen(true),
      ...controls.filter((one) => !behind(one)).map(control), ...chosen(false),
      ...controls.filter(behind).map(control))
  }
  // A form of which nothing is ever submitted.
  const form = (attributes, ...parts) => {
    const made = element("form", attributes, ...parts)
    made.addEventListener("submit", (event) => event.preventDefault())
    return made
  }

  return { rows, selects, values, limits, control, choice, group_box, form, take, listen, refuse, send, push, put, move, move_all, release,
           drawn: () => asked() <= drawn() || late() }
}
