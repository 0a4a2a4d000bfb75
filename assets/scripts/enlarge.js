// A view over the whole screen and back: its figures share the height that is left. A drawing of many
// cells shows one of them with its axes, and arrows lead to the next; on a projector and a phone it begins
// with the one that a lesson names.

const SENTENCE = 70    // px below enlarged figures
const NARROW = 820, LOW = 300  // px, of a phone and of a cell on it

function enlarging(model, root) {
  const part = (id) => root.querySelector(`#${id}`)
  const enlarge = part("enlarge"), name = part("cell"), steps = part("steps"), page = document.documentElement
  const host = () => enlarge.getRootNode().host?.getRootNode().host  // the view
  const is_large = () => Boolean(host()?.matches(".enlarged"))
  const heights = new Map()  // of its figures, while it is enlarged
  const resize = () => {
    const plots = figures_on_screen(model.figures)
    const rows = new Set(plots.map(({ el }) => Math.round(el.getBoundingClientRect().top))).size
    const end = Math.max(...plots.map(({ el }) => el.getBoundingClientRect().bottom))
    const more = Math.floor((innerHeight - end - SENTENCE) / rows)
    for (const { model: plot } of more > 0 ? plots : []) {
      if (!heights.has(plot)) heights.set(plot, plot.height)
      if (plot.height) plot.setv({ height: plot.height + more }, { sync: false })
    }
  }

  let cell = -1  // the one that fills the drawing; -1 if all are shown
  const explain = () => {
    host()?.classList.toggle("of-cell", Boolean(model.cell_lines[cell]))  // which is of another term than its sentence
    if (model.cell_lines[cell]) part("line").innerHTML = model.cell_lines[cell]
    else part("line").textContent = model.line
  }
  model.on("cell_lines", explain)
  const show_cell = (number) => {
    const [view] = figures_on_screen(model.figures)
    if (!view) return
    cell = number < 0 ? -1 : number % model.cells.length
    const [words, ...sides] = model.cells[cell] ?? ["All"]
    const { x_range, y_range } = view.model
    const home = [x_range.reset_start, x_range.reset_end, y_range.reset_start, y_range.reset_end]
    const [left, right, bottom, top] = cell < 0 ? home : sides
    x_range.setv({ start: left, end: right })
    y_range.setv({ start: bottom, end: top })
    const terms = model.cells.filter(([symbol]) => symbol.startsWith("k ")).length  // the number of loaded balls is none
    name.innerHTML = words.replace(/^k (.+)/, `k<sub>$1</sub>, ${cell + 1} of ${terms}`)
    explain()
  }
  const step = (by) => show_cell(cell < 0 ? (by > 0 ? 0 : model.cells.length - 1) : (cell + by + model.cells.length) % model.cells.length)
  part("previous").addEventListener("click", () => step(-1))
  part("next").addEventListener("click", () => step(1))
  part("all").addEventListener("click", () => show_cell(-1))

  const set_large = (large) => {
    const view = host()
    view.popover = large ? "manual" : null
    view.classList.toggle("enlarged", large)
    enlarge.textContent = large ? "Close" : "Enlarge"
    steps.hidden = !(large && model.cells.length)
    if (large) view.showPopover()
    else {
      for (const [plot, height] of heights) plot.setv({ height }, { sync: false })
      heights.clear()
    }
    if (model.cells.length) show_cell(-1)
    enlarge.focus()
  }
  enlarge.addEventListener("click", () => set_large(!is_large()))
  on_event("laid-out", enlarge, () => { if (is_large()) resize() })
  while_there("keydown", enlarge, (event) => {
    if (!(is_large() || named) || event.defaultPrevented) return
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key]
    const [at] = event.composedPath()
    if (event.key === "Escape" && is_large() && !at.closest?.("dialog, [popover]:not(.view)")) set_large(false)
    else if (by && model.cells.length && !at.matches?.("input, select")) {
      event.preventDefault()
      step(by)
    }
  })
  on_event("tab", enlarge, () => { if (is_large()) set_large(false) })
  let named = "", own_size = null  // by a lesson, where there is room for one
  const show_named = () => {
    const projected = page.hasAttribute("data-projector"), small = innerWidth <= NARROW
    const wanted = (projected || small) && model.cells.length ? page.dataset.cell ?? "" : ""
    if (wanted === named || is_large()) return  // where the figure is is asked for no sooner: each layout comes here
    const [view] = figures_on_screen(model.figures)
    if (!view) return
    named = wanted
    steps.hidden = !named
    root.classList.toggle("only-steps", Boolean(named) && projected)
    if (small) {
      const { sizing_mode, height, min_height } = view.model
      own_size ??= { sizing_mode, height, min_height }
      view.model.setv(named ? { sizing_mode: "stretch_width", height: LOW, min_height: null } : own_size, { sync: false })
    }
    show_cell(model.cells.findIndex(([words]) => words === named))
  }
  for (const event of ["lesson", "projector", "laid-out"]) on_event(event, enlarge, show_named)
  on_event("cell", enlarge, ({ figure, x, y }) => {  // a cell is clicked at
    if (!model.figures.includes(figure) || cell >= 0) return
    const at = model.cells.findIndex(([, left, right, bottom, top]) => x > left && x < right && y > bottom && y < top)
    if (at < 0) return
    if (!is_large() && !named) set_large(true)
    show_cell(at)
  })
  return enlarge
}
