// Notes when changes are asked for, when the hand moves, and each paint: [mark, when, how long].
() => {
  window.__asks = {}
  window.__moves = []
  window.__paints = []
  let asked = window.__asked || 0
  Object.defineProperty(window, "__asked", {
    get: () => asked,
    set: (mark) => { asked = mark; window.__asks[mark] = performance.now() },
  })
  window.addEventListener("input", () => window.__moves.push(performance.now()), true)
  const wrapped = new Set()
  for (const view of Bokeh.index.query((one) => typeof one._actual_paint === "function")) {
    let owner = view
    while (owner && !Object.hasOwn(owner, "_actual_paint")) owner = Object.getPrototypeOf(owner)
    if (!owner || wrapped.has(owner)) continue
    wrapped.add(owner)
    const paint = owner._actual_paint
    owner._actual_paint = function (...rest) {
      const began = performance.now(), mark = window.__mark
      const result = paint.apply(this, rest)
      window.__paints.push([mark, performance.now(), performance.now() - began])
      return result
    }
  }
  let seen = -1
  // asked for by each picture: a watch that looks at every frame of the screen is work too
  window.addEventListener("explorer-drawn", () => {
    if (window.__mark === seen) return
    const mark = seen = window.__mark
    requestAnimationFrame(() => window.__paints.push([mark, performance.now(), 0]))
  })
}
