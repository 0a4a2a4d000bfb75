// One live sentence. Only the text changes: no layout, no repaint of the figure above it.
// A stiffness such as k_yy has its directions under its letter, and a unit stays with its number.
const TERM = /\bk_([xyzθ]+)/
const BEFORE_UNIT = /(?<=\d) (?=(?:%|dB|rpm|[kMGmnµ]?(?:Hz|Pa|[NmsgV]))(?!\w))/g
function written(text) {
  return text.replace(BEFORE_UNIT, "\u00a0").split(TERM).flatMap((part, i) => {
    if (i % 2 === 0) return [part]
    const below = document.createElement("sub")
    below.textContent = part
    return ["k", below]
  })
}

export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  const write = () => { line.replaceChildren(...written(model.text)) }
  model.on("text", write)
  write()
  return line
}
