// The status line: a chip whose words say what its colour says, and details. Where the line is
// folded, a click on the chip opens them as a list above it.
export function render({ model }) {
  const chip = element("strong")
  const more = element("button", { type: "button", class: "chip", "aria-controls": "status-list", title: "Details of the computation" })
  const list = model.folded ? element("ul", { id: "status-list", class: "list" }) : element("span")
  const line = element("div", { class: "line" }, chip, ...(model.folded ? [more] : []), list)
  // of a folded line only the chip is live: reading out each residual would be noise
  const live = model.folded ? chip : line
  live.setAttribute("role", "status")
  const open = model.folded && unfolds(more, list)
  follow(model, ["line"], () => {
    const { mood, words, details, tab, resting } = model.line
    if (tab) Object.assign(window, { __tab: tab, __resting: resting })  // for tests and benchmarks
    line.dataset.mood = mood
    if (chip.textContent !== words) chip.textContent = more.textContent = words
    more.disabled = !details.length
    if (open && !details.length) open(false)
    if (model.folded) list.replaceChildren(...details.map((detail) => element("li", {}, detail)))
    else list.textContent = details.join("  ·  ")
  })
  // Until the first kernels are compiled sliders would move nothing: they say so by not moving.
  const bar = element("progress"), said = element("span")
  const progress = element("div", { class: "progress", role: "status" }, bar, said)
  follow(model, ["progress"], () => {
    const { done = 0, of = 0, words = "", still = false } = model.progress
    progress.hidden = !of
    document.documentElement.toggleAttribute("data-compiling", of > 0)
    Object.assign(bar, { value: done, max: of || 1 })
    said.textContent = words
    bar.setAttribute("aria-label", words)
    if (model.folded) for (const part of document.querySelectorAll(".controls-place, #welcome"))
      part.toggleAttribute("inert", still)
  })
  return element("div", {}, progress, line)
}
