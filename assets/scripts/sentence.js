// One live sentence, as HTML. Only it changes: no layout, no repaint of the figure above it.
export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  const write = () => { line.innerHTML = model.text }
  model.on("text", write)
  write()
  return line
}
