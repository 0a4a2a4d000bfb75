// The controls: sliders with numbers to type into, choices, play.
//
// What a hand moves is sent at once, but never more than two changes ahead of what is drawn
// (`window.__mark` is the number of the newest change drawn): a slow server is asked less often,
// and always for the newest position. The server judges everything; a refusal comes back as a
// sentence that is shown beside its control.

const TURN_RATE = 18      // degrees of cage angle a second while playing
const AHEAD = 2           // changes that may be on their way
const PATIENCE = 400      // ms until a change counts as lost

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes))
    name === "html" ? (made.innerHTML = value) : made.setAttribute(name, value)
  made.append(...children)
  return made
}

const format = (value, step) => {
  const digits = Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)))
  // A typed number keeps its own digits, a dragged one those of the step.
  const short = Number(value.toFixed(digits))
  return String(Math.abs(short - value) < 1e-9 * (1 + Math.abs(value)) ? short : value)
    .replace("-", "\u2212")
}

export function render({ model }) {
  const spec = model.spec
  const rows = {}
  let limits = {}, values = {}
  let asked = window.__asked || 0
  let pending = null, sent_at = 0, waiting = false

  const send = (message) => {
    asked += 1
    window.__asked = asked
    sent_at = performance.now()
    model.send_msg({ mark: asked, ...message })
  }
  const pump = () => {
    waiting = false
    if (pending === null) return
    const ahead = asked - (window.__mark || 0)
    if (ahead >= AHEAD && performance.now() - sent_at < PATIENCE) {
      waiting = true
      requestAnimationFrame(pump)
      return
    }
    const set = pending
    pending = null
    send({ set })
  }
  const push = (name, value) => {
    pending = { ...pending, [name]: value }
    if (!waiting) pump()
  }

  const paint = (name) => {
    const row = rows[name], limit = limits[name], value = values[name]
    const share = (v) => 100 * (v - limit.least) / (limit.most - limit.least)
    const origin = limit.least < 0 && limit.most > 0 ? 0 : limit.least
    const ends = [share(origin), share(value)].sort((a, b) => a - b)
    row.slider.style.setProperty("--from", `${ends[0]}%`)
    row.slider.style.setProperty("--to", `${ends[1]}%`)
    row.slider.setAttribute("aria-valuetext", `${format(value, limit.step)} ${row.unit}`)
    if (name === spec.speed) row.extra.textContent = `${Math.round(value * 60)} rpm`
  }
  const put = (name, value) => {
    const row = rows[name]
    values[name] = value
    row.slider.value = value
    if (row.root.querySelector("input:focus") !== row.number)
      row.number.value = format(value, limits[name].step)
    paint(name)
  }
  const refuse = (name, sentence) => {
    const row = rows[name]
    row.refusal.textContent = sentence
    row.refusal.hidden = !sentence
    row.root.classList.toggle("refused", !!sentence)
    row.number.setAttribute("aria-invalid", sentence ? "true" : "false")
  }

  const control = ({ name, label, symbol, unit, about }) => {
    const id = `control-${name}`
    const slider = element("input", { type: "range", id, "aria-describedby": `${id}-refusal` })
    const number = element("input", {
      type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false",
      class: "number", "aria-label": `${label} in ${unit}, type a number`,
    })
    const refusal = element("p", { class: "refusal", role: "alert", id: `${id}-refusal` })
    const extra = element("span", { class: "extra" })
    const symbolic = element("i", { class: "symbol", html: symbol })
    const head = element("div", { class: "head" },
      element("label", { for: id, title: about }, label, " ", symbolic), extra,
      element("span", { class: "entry" }, number, element("span", { class: "unit" }, unit)))
    const line = element("div", { class: "line" }, slider)
    const root = element("div", { class: `control control-${name}`, "data-name": name },
      head, line, refusal)
    refusal.hidden = true
    rows[name] = { root, slider, number, refusal, extra, unit }

    slider.addEventListener("input", () => {
      refuse(name, "")
      values[name] = Number(slider.value)
      number.value = format(values[name], limits[name].step)
      paint(name)
      push(name, values[name])
    })
    number.addEventListener("change", () => send({ typed: { [name]: number.value } }))
    number.addEventListener("focus", () => number.select())
    number.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        refuse(name, "")
        number.value = format(values[name], limits[name].step)
      } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
        event.preventDefault()
        const { least, most, step } = limits[name]
        const moved = values[name] + (event.key === "ArrowUp" ? step : -step)
        const value = Number(Math.min(most, Math.max(least, moved)).toPrecision(12))
        refuse(name, "")
        put(name, value)
        number.value = format(value, step)
        push(name, value)
      }
    })
    if (name === spec.turning) line.prepend(play(name))
    return root
  }

  const play = (name) => {
    const button = element("button", { type: "button", class: "play", "aria-pressed": "false" })
    let last = 0, playing = false
    const show = () => {
      button.setAttribute("aria-pressed", String(playing))
      button.setAttribute("aria-label", playing ? "Stop turning" : "Turn the bearing")
      button.title = playing ? "Stop" : "Turn the bearing"
      button.innerHTML = playing
        ? '<svg viewBox="0 0 12 12" aria-hidden="true"><path d="M2 1h3v10H2zM7 1h3v10H7z"/></svg>'
        : '<svg viewBox="0 0 12 12" aria-hidden="true"><path d="M2.5 1v10l8-5z"/></svg>'
    }
    const turn = (now) => {
      if (!playing || !button.isConnected) return
      const passed = Math.min(now - last, 250)
      // The next angle is asked for when the last one is drawn: turning never outruns drawing.
      const drawn = asked <= (window.__mark || 0) || now - sent_at > PATIENCE
      if (drawn && passed >= 30) {
        last = now
        put(name, Number(((values[name] + TURN_RATE * passed / 1000) % 360).toFixed(3)))
        rows[name].number.value = format(Number(values[name].toFixed(1)), limits[name].step)
        push(name, values[name])
      }
      requestAnimationFrame(turn)
    }
    button.addEventListener("click", () => {
      playing = !playing
      show()
      last = performance.now()
      if (playing) requestAnimationFrame(turn)
    })
    show()
    return button
  }

  const selects = {}
  const choice = (name, ...extra) => {
    const { label, options } = spec.choices[name]
    const select = element("select", { id: `choice-${name}` })
    const note = element("p", { class: "note" })
    for (const option of options)
      select.append(element("option", { value: option.value, title: option.about }, option.label))
    select.addEventListener("change", () => send({ choose: { [name]: select.value } }))
    selects[name] = { select, show: (value) => {
      select.value = value
      note.textContent = options.find((option) => option.value === value)?.about ?? ""
    } }
    const more = element("button", {
      type: "button", class: "info", "aria-expanded": "false", "aria-controls": `note-${name}`,
      "aria-label": `About this ${label.toLowerCase()}`, title: "About this choice",
    }, "?")
    note.id = `note-${name}`
    note.hidden = true
    more.addEventListener("click", () => {
      note.hidden = !note.hidden
      more.setAttribute("aria-expanded", String(!note.hidden))
    })
    const head = element("div", { class: "head" },
      element("label", { for: `choice-${name}` }, label), ...extra, more)
    return element("div", { class: `choice choice-${name}` }, head, select, note)
  }

  const take = (state) => {
    if (state.limits) {
      limits = state.limits
      for (const [name, { least, most, step }] of Object.entries(limits))
        Object.assign(rows[name].slider, { min: least, max: most, step })
    }
    for (const [name, value] of Object.entries(state.values ?? {})) {
      refuse(name, "")
      put(name, value)
      rows[name].number.value = format(value, limits[name].step)
    }
    for (const [name, value] of Object.entries(state.choices ?? {})) selects[name].show(value)
  }

  const reset = element("button", { type: "button", class: "reset", title: "Back to the numbers of this bearing" }, "Reset")
  reset.addEventListener("click", () => send({ reset: true }))
  const form = element("form", { "aria-label": "Scene" }, choice("preset", reset))
  form.addEventListener("submit", (event) => event.preventDefault())
  for (const group of spec.groups) {
    const box = element("fieldset", {}, element("legend", {}, group.title))
    box.append(...group.controls.map(control))
    for (const name of Object.keys(spec.choices))
      if (spec.choices[name].group === group.title) box.append(choice(name))
    form.append(box)
  }
  take(model.state)
  model.on("msg:custom", (message) => {
    if (message.state) take(message.state)
    for (const [name, sentence] of Object.entries(message.refused ?? {})) refuse(name, sentence)
  })
  return form
}
