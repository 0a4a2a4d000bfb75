// Facts and tables as HTML that change while a slider moves. Only they change: no layout.
export function render({ model }) {
  const part = document.createElement("div")
  const write = () => { part.innerHTML = model.text }
  model.on("text", write)
  write()
  return part
}
