// One live sentence, as HTML. Only it changes: no layout, no repaint of the figure above it.
export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  const write = () => { line.innerHTML = model.text }
  model.on("text", write)
  write()
  // as high as it has been at this width, to the part of a pixel: a shorter one would have figures
  // grow, and repaint
  let width
  new ResizeObserver(([{ contentRect, borderBoxSize: [{ blockSize }] }]) => {
    line.style.minHeight = contentRect.width === width ? `${blockSize}px` : ""
    width = contentRect.width
  }).observe(line)
  return line
}
