// A measured signal: chosen or dropped as a file, sent in pieces, asked about; or simulated.
export function render({ model }) {
  const spec = model.spec
  const select = (id, options) => element("select", { id },
    ...options.map(([value, words]) => element("option", { value }, words)))
  const labelled = (id, words, input, note = "") => element("div", { class: `field field-${id}` },
    element("label", { for: id }, words), input,
    element("p", { class: "refusal", id: `${id}-refusal` }, note),
    element("p", { class: "reason", id: `${id}-reason` }))

  // Files: the server says where the next piece shall begin, so it is never asked to hold more.
  const file = element("input", { type: "file", id: "measurement-file" })
  const choose = element("label", { for: "measurement-file", class: "choose" }, "Choose a file …")
  const bar = element("div", { class: "bar", role: "progressbar", "aria-label": "File on its way",
    "aria-valuemin": "0", "aria-valuemax": "100", hidden: "" }, element("i"))
  let sending = null, answers = 0
  const begin = (chosen) => {
    if (!chosen) return
    sending = chosen.size <= spec.most ? chosen : null
    far(0)
    model.send_msg({ file: { name: chosen.name, size: chosen.size } })
  }
  const far = (share) => {
    bar.hidden = !sending
    bar.firstChild.style.width = `${100*share}%`
    bar.setAttribute("aria-valuenow", String(Math.round(100*share)))
  }
  const send = async (from, of) => {
    if (of < answers) return  // the server speaks of a file that was given up
    answers = of
    const source = sending
    if (!source || from >= source.size) return
    let piece
    try {
      piece = await source.slice(from, from + spec.piece).arrayBuffer()
    } catch {
      piece = null  // the file is gone or may not be read: the server says so
    }
    if (source !== sending) return
    const sent = from + (piece?.byteLength ?? 0)
    far(sent/source.size)
    if (!piece || sent >= source.size) sending = null
    model.send_msg({ piece, of })
    if (!sending) setTimeout(() => far(1), 300)
  }
  file.addEventListener("change", () => {
    begin(file.files[0])
    file.value = ""  // so that the same file, mended, can be chosen again
  })

  // Simulated measurements, for those who have none.
  const noise = select("measurement-noise", spec.noises)
  const machine = select("measurement-machine", spec.machines)
  const pit = select("measurement-pit", spec.pits)
  const simulate = element("button", { type: "button", class: "start" }, "Simulate a signal")
  simulate.addEventListener("click", () =>
    model.send_msg({ simulate: { noise: noise.value, machine: machine.value, pit: pit.value } }))

  const own = element("section", { class: "way own", "aria-label": "A file of your own" },
    element("h3", {}, "A file of your own"),
    element("div", { class: "line" }, choose, file, bar),
    element("p", { class: "note" }, spec.formats))
  const made = element("section", { class: "way", "aria-label": "No file at hand" },
    element("h3", {}, "No file at hand?"),
    element("div", { class: "line" }, simulate,
      labelled("measurement-noise", "Noise below the signal", noise),
      labelled("measurement-machine", "Machine", machine),
      labelled("measurement-pit", "Defect", pit)),
    element("p", { class: "note" }, "Of the scene beside: its true extent is known and shown."))

  // What the file does not say for sure.
  const inputs = {
    x: select("measurement-x", []), y: select("measurement-y", []),
    unit: select("measurement-unit", []),
    full_scale: element("input", { type: "text", id: "measurement-full_scale", inputmode: "decimal", autocomplete: "off" }),
    sensitivity: element("input", { type: "text", id: "measurement-sensitivity", inputmode: "decimal", autocomplete: "off",
      placeholder: `${spec.usual_sensitivity} is usual` }),
    sample_rate: element("input", { type: "text", id: "measurement-sample_rate", inputmode: "decimal", autocomplete: "off" }),
    shaft_speed: element("input", { type: "text", id: "measurement-shaft_speed", autocomplete: "off" }),
  }
  const words = { x: "Along x, sideways", y: "Along y, up", unit: "Unit",
    full_scale: "1 in the file is", sensitivity: "Sensor (mV/g)", sample_rate: "Sample rate (Hz)", shaft_speed: "Shaft speed (Hz or rpm)" }
  const fields = Object.fromEntries(Object.entries(inputs).map(([name, input]) =>
    [name, labelled(`measurement-${name}`, words[name], input)]))
  const agree = element("button", { type: "submit", class: "start agree" }, "Use these answers")
  const form = element("form", { class: "asked", "aria-label": "What the file holds" }, ...Object.values(fields), agree)
  const answer = (sure) => model.send_msg({ sure, form: Object.fromEntries(
    Object.entries(inputs).map(([name, input]) => [name, input.value])) })
  form.addEventListener("change", () => answer(false))
  form.addEventListener("submit", (event) => {
    event.preventDefault()
    answer(true)
  })
  const facts = element("p", { class: "note facts" })
  const load = element("button", { type: "button", class: "start load" }, "")
  load.addEventListener("click", () => model.send_msg({ load: true }))
  const told = element("div", { class: "line told" }, facts, load)

  const said = element("p", { class: "words", role: "status" })
  const root = element("div", { class: "measurement" },
    element("div", { class: "ways" }, own, made), form, told, said)

  for (const kind of ["dragenter", "dragover"]) root.addEventListener(kind, (event) => {
    event.preventDefault()
    root.classList.add("over")
  })
  for (const kind of ["dragleave", "drop"]) root.addEventListener(kind, (event) => {
    if (kind === "dragleave" && root.contains(event.relatedTarget)) return
    event.preventDefault()
    root.classList.remove("over")
  })
  root.addEventListener("drop", (event) => begin(event.dataTransfer?.files[0]))

  const show = () => {
    const { words: sentence, bad, busy, columns, values, refused, reasons, open, said: beside,
            load: newtons, scaled, proposed } = model.state
    if (said.textContent !== sentence) said.textContent = sentence
    root.dataset.mood = bad ? "bad" : busy ? "busy" : "good"
    form.hidden = !columns.length
    for (const name of ["x", "y"])
      inputs[name].replaceChildren(...columns.map(([value, text]) => new Option(text, value)))
    // a unit that the file does not say is nobody's until somebody has chosen it
    const asked = proposed === null ? [] : [["", proposed ? `choose (${proposed} is likely)` : "choose"]]
    inputs.unit.replaceChildren(...[...asked, ...spec.units].map(([value, text]) => new Option(text, value)))
    for (const [name, input] of Object.entries(inputs)) {
      if (values[name] !== undefined) input.value = values[name]
      const wrong = refused[name] ?? ""
      fields[name].querySelector(".refusal").textContent = wrong
      input.setAttribute("aria-invalid", wrong ? "true" : "false")
      input.setAttribute("aria-describedby", `measurement-${name}-refusal measurement-${name}-reason`)
      fields[name].querySelector(".reason").textContent = wrong ? "" : reasons[name] ?? ""
      fields[name].classList.toggle("open", open.includes(name))
    }
    agree.hidden = open.every((name) => spec.sizes.includes(name))
    facts.textContent = beside
    load.hidden = !newtons
    load.textContent = newtons ? `Load the scene with ${Number(newtons.toPrecision(3))} N, downwards` : ""
    told.hidden = !beside
    fields.full_scale.hidden = !scaled && (values.full_scale ?? "1") === "1"
    fields.sensitivity.hidden = !["V", "mV"].includes(values.unit)
  }
  model.on("state", show)
  model.on("msg:custom", (message) => { if (message.want !== undefined) send(message.want, message.of) })
  show()
  return root
}
