// One live sentence, as HTML. Only it changes: no layout, no repaint of the figure above it.
export function render({ model }) {
  const line = document.createElement("p")
  line.setAttribute("role", "status")
  // It stays as high as it has been at this width, to the part of a pixel, and its view grows downwards
  // with it: the figure above keeps its size, so that nothing moves under a hand that drags in it.
  let width, first = 0, longest = 0  // height [px] as it first stood at this width; most signs since
  const keep_height = () => {
    const height = parseFloat(getComputedStyle(line).height) || 0
    first ||= height
    longest = Math.max(longest, line.textContent.length)
    line.style.minHeight = `${height}px`
    const view = line.getRootNode().host?.getRootNode().host
    for (const part of [view, view?.getRootNode().host]) part?.style.setProperty("--longer", `${height - first}px`)
  }
  const write = () => {
    line.innerHTML = model.text
    if (first && line.textContent.length > longest) keep_height()
  }
  model.on("text", write)
  write()
  // the rolling elements that it names light up in the figures (see pointed.js); of several rows none
  const point = (named) => {
    const numbers = [...named.matchAll(/\b(?:ball|roller)s? ([\d, and]*\d)(?! of row)/gi)].flatMap(([, list]) => list.match(/\d+/g))
    window.dispatchEvent(new CustomEvent("explorer-pointed", { detail: numbers.map(Number) }))
  }
  line.addEventListener("pointerenter", () => point(line.textContent))
  line.addEventListener("pointerleave", () => point(""))
  new ResizeObserver(([{ contentRect }]) => {
    if (contentRect.width !== width) {
      [width, first, longest] = [contentRect.width, 0, 0]
      line.style.minHeight = ""
    }
    keep_height()
  }).observe(line)
  return line
}
