// One live sentence, as HTML. Only it changes: no layout, no repaint of the figure above it.
export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  const write = () => { line.innerHTML = model.text }
  model.on("text", write)
  write()
  // the rolling elements that it names light up in the figures (see pointed.js); of several rows none
  const point = (named) => {
    const numbers = [...named.matchAll(/\b(?:ball|roller)s? ([\d, and]*\d)(?! of row)/gi)].flatMap(([, list]) => list.match(/\d+/g))
    window.dispatchEvent(new CustomEvent("explorer-pointed", { detail: numbers.map(Number) }))
  }
  line.addEventListener("pointerenter", () => point(line.textContent))
  line.addEventListener("pointerleave", () => point(""))
  // as high as it has been at this width, to the part of a pixel: a shorter one would have figures
  // grow, and repaint
  let width
  new ResizeObserver(([{ contentRect, borderBoxSize: [{ blockSize }] }]) => {
    line.style.minHeight = contentRect.width === width ? `${blockSize}px` : ""
    width = contentRect.width
  }).observe(line)
  return line
}
