// One live sentence, as HTML. Only it changes: no layout, no repaint of the figure above it.
const BEFORE_UNIT = /(?<=\d) (?=(?:%|dB|rpm|[kMGmnµ]?(?:Hz|Pa|[NmsgV]))(?!\w))/g

export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  const write = () => { line.innerHTML = model.text.replace(BEFORE_UNIT, "\u00a0") }
  model.on("text", write)
  write()
  return line
}
