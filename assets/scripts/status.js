// The status line. The chip says in words what its colour says; where the line is folded, all else
// opens above it when asked for.
export function render({ model }) {
  const chip = element("strong")
  const rest = element("span")
  const more = element("button", { type: "button", class: "more", "aria-expanded": "false",
                                   "aria-controls": "status-list" }, "Details")
  const list = element("ul", { id: "status-list", class: "list", "aria-label": "How it was computed" })
  list.hidden = true
  // of a folded line only the chip is live: nobody wants to hear each residual
  const line = model.folded ? element("div", { class: "line" }, chip, more, list)
    : element("div", { class: "line", role: "status" }, chip, rest)
  if (model.folded) chip.setAttribute("role", "status")
  const REST = 200  // ms: what nobody sees is written when the hand rests
  let later
  const write_list = () => {
    clearTimeout(later)
    list.replaceChildren(...model.line.details.map((detail) => element("li", {}, detail)))
  }
  const write_list_later = () => {
    clearTimeout(later)
    later = setTimeout(write_list, REST)
  }
  const open = (shown) => {
    if (shown) write_list()
    list.hidden = !shown
    more.setAttribute("aria-expanded", String(shown))
  }
  more.addEventListener("click", () => open(list.hidden))
  line.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !list.hidden) {
      open(false)
      more.focus()
    }
  })
  const write = () => {
    const { mood, words, details, tab, resting } = model.line
    if (tab) Object.assign(window, { __tab: tab, __resting: resting })  // for tests and benchmarks
    if (line.dataset.mood !== mood) line.dataset.mood = mood
    if (chip.textContent !== words) chip.textContent = words
    more.hidden = !details.length
    if (!details.length && !list.hidden) open(false)
    if (model.folded && list.hidden) write_list_later()
    else if (model.folded) write_list()
    else rest.textContent = details.join("  ·  ")
  }
  model.on("line", write)
  write()
  return line
}
