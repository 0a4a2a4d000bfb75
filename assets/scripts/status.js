// The status line. The chip says in words what its colour says.
export function render({ model }) {
  const line = document.createElement("div")
  const chip = document.createElement("strong")
  const rest = document.createElement("span")
  line.setAttribute("role", "status")
  line.className = "line"
  line.append(chip, rest)
  const write = () => {
    const { mood, words, details } = model.line
    line.dataset.mood = mood
    if (chip.textContent !== words) chip.textContent = words
    rest.textContent = details.join("  ·  ")
    rest.title = rest.textContent  // where the line is cut short
  }
  model.on("line", write)
  write()
  return line
}
