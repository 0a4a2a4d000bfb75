// The numbers of many cells on the axes of the drawing that they stand in, while it is zoomed into.
// See app/bearing_explorer/explorer/plots/matrix_cells.py. `scale_of` is put in front of this file.
const MOST_TICKS = {x: 8, y: 6}
const {x_range, y_range} = plot
const zoomed = [x_range, y_range].some(({start, end}, i) =>
  Math.abs(start - home[i][0]) + Math.abs(end - home[i][1]) > 1e-6*(home[i][1] - home[i][0]))
const seen = cells.map(([left, right, bottom, top], k) => ({k, left, right, bottom, top}))
  .filter(({left, right, bottom, top}) =>
    right > x_range.start && left < x_range.end && top > y_range.start && bottom < y_range.end)
const nice = (least) => {
  const power_of_ten = 10**Math.floor(Math.log10(least))
  return [1, 2, 5, 10].map((m) => m*power_of_ten).find((step) => step >= 0.999*least)
}
// Ticks of a side: of the cells next to the axis, one behind another along it.
const ticks_of = (side, {start, end}, near, [first_end, last_end]) => {
  const taken = [], ticks = []
  for (const cell of [...seen].sort((a, b) => a[near] - b[near])) {
    const from = Math.max(cell[first_end], start), to = Math.min(cell[last_end], end)
    if (taken.some(([a, b]) => from < b && to > a)) continue
    taken.push([from, to])
    const {first, last, factor, unit} = scale_of(cell.k)[side]
    const size = cell[last_end] - cell[first_end]
    const value = (at) => (first + (at - cell[first_end])/size*(last - first))/factor
    const [low, high] = [value(from), value(to)]
    if (!(high > low)) continue
    const step = nice((high - low)/Math.max(1, MOST_TICKS[side]*(to - from)/(end - start)))
    for (let n = Math.ceil(low/step - 1e-9); n*step <= high + 1e-9*step; n++) {
      const at = cell[first_end] + (n*step*factor - first)/(last - first)*size
      ticks.push({at, words: minus(String(Number((n*step).toPrecision(6)))), unit})
    }
  }
  return ticks
}
const label = (side) => {
  const {unit, words} = scale_of(seen[0].k)[side]
  const own = cell_names[seen[0].k].replace(/^k /, "k_")
  if (seen.length > 1) return words ? `${words} (${unit})` : ""
  const name = !words ? own : side === "x" ? `${own} over ${words[0].toLowerCase()}${words.slice(1)}` : words
  return unit ? `${name} (${unit})` : name
}
const shows = zoomed && seen.length > 0
const along = {x: [x_range, "bottom", ["left", "right"]], y: [y_range, "left", ["bottom", "top"]]}
;["x", "y"].forEach((side, i) => {
  const [axis, ticker, shown] = axes[i]
  if (shows) {
    const ticks = ticks_of(side, ...along[side])
    const in_label = seen.length === 1 || new Set(ticks.map(({unit}) => unit)).size < 2
    shown.data = {at: ticks.map(({at}) => at),
      words: ticks.map(({words, unit}) => in_label ? words : `${words}\u00a0${unit}`)}
    ticker.ticks = shown.data.at
    const text = label(side)
    if (axis.axis_label !== text) axis.axis_label = text
  }
  if (axis.visible !== shows) axis.visible = shows
})
