// Which part of the bearing is damaged: a picture with the part marked, the answer in words, on
// what it rests, and a sentence to pass on.

function shape(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag)
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value)
  made.append(...children)
  return made
}

const PICTURES = {
  busy: "Bearing; the signal is being looked at",
  healthy: "Bearing, no part marked: no damage seen",
  unknown: "Bearing with a question mark: it cannot be told which part is damaged",
}

// The bearing along the shaft, to scale; `part` is marked.
function part_picture(bearing, mood, part) {
  const { n_balls, pitch, ball, outer, inner } = bearing
  const rim = outer + 0.45 * ball, bore = Math.max(inner - 0.45 * ball, 0.3 * inner)
  const scale = 96 / rim
  const ring = (radius, hole, cls) => {
    const circle = (r) => `M${-r} 0A${r} ${r} 0 1 1 ${r} 0A${r} ${r} 0 1 1 ${-r} 0Z`
    return shape("path", { class: cls, "fill-rule": "evenodd", d: circle(scale * radius) + circle(scale * hole) })
  }
  const marked = (name) => mood === "fault" && part === name
  const cls = (name, usual) => marked(name) ? `${usual} marked` : usual
  const balls = Array.from({ length: Math.min(n_balls, 60) }, (_, i) => {
    const turn = 2 * Math.PI * i / n_balls + Math.PI / 2
    const first = i === 0 && marked("ball")
    return shape("circle", { class: first ? "ball marked" : "ball", r: 0.5 * scale * ball,
      cx: 0.5 * scale * pitch * Math.cos(turn), cy: 0.5 * scale * pitch * Math.sin(turn) })
  })
  const words = mood === "fault" ? `Bearing, ${part} marked` : PICTURES[mood]
  const svg = shape("svg", { viewBox: "-104 -104 208 208", role: "img", "aria-label": words, "data-part": mood === "fault" ? part : "" },
    ring(rim, outer, cls("outer race", "steel")), ring(inner, bore, cls("inner race", "steel")), ...balls)
  // where it strikes: below, as if that were where the load is
  const spot = { "outer race": [0, scale * outer], "inner race": [0, scale * inner], ball: [0, 0.5 * scale * (pitch + ball)] }[part]
  if (mood === "fault" && spot) {
    const [x, y] = spot, size = Math.max(0.22 * scale * ball, 4.5)
    const rays = Array.from({ length: 8 }, (_, i) => {
      const turn = Math.PI * (i + 0.5) / 4, c = Math.cos(turn), s = Math.sin(turn)
      return `M${x + size * c} ${y + size * s}L${x + 2.1 * size * c} ${y + 2.1 * size * s}`
    })
    svg.append(shape("path", { class: "rays", d: rays.join("") }), shape("circle", { class: "spot", cx: x, cy: y, r: 0.55 * size }))
  }
  if (mood === "unknown") svg.append(shape("text", { class: "question", x: 0, y: 0, "text-anchor": "middle", "dominant-baseline": "central" }, "?"))
  return svg
}

export function render({ model }) {
  const place = element("div", { class: "place" })
  const head = element("h3")
  const probability = element("p", { class: "probability" })
  const plain = element("p", { class: "plain" })
  const facts = element("dl")
  const pass_on = element("p", { class: "hand-on" })
  const said = element("span", { class: "said", "aria-live": "polite" })
  const copy = element("button", { type: "button" }, "Copy")
  copy.addEventListener("click", async () => {
    if (await copy_text(pass_on.textContent)) said.textContent = "Copied."
    else {
      getSelection().selectAllChildren(pass_on)
      said.textContent = "Marked: copy by hand."
    }
  })
  const handed = element("div", { class: "handed" },
    element("div", { class: "bar" }, element("strong", {}, "To pass on"), said, copy), pass_on)
  const root = element("section", { class: "part", "aria-label": "Which part is damaged" }, place,
    element("div", { class: "answer" }, head, probability, plain, handed),
    element("div", { class: "rests" }, element("h4", {}, "Taken to be so"), facts))
  const show = () => {
    const { mood, part = "", color = "", headline = "", probability: sure = "", plain: words = "", pass_on: sentence = "", facts: rows = [], bearing } = model.state
    root.dataset.mood = mood
    root.style.setProperty("--part", color || "var(--accent)")
    place.replaceChildren(...(bearing ? [part_picture(bearing, mood, part)] : []))
    head.textContent = headline
    probability.textContent = sure
    plain.textContent = words
    pass_on.textContent = sentence
    handed.hidden = !sentence
    said.textContent = ""
    facts.replaceChildren(...rows.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))))
    facts.parentNode.hidden = !rows.length
  }
  model.on("state", show)
  show()
  return root
}
