// Light or dark, and large type for a projector. Runs before the page is drawn. Styles follow
// `data-theme` and `data-projector` of the root element; figures follow `window.__themes`, which
// names the dark colour for each light one, and are changed in the browser alone, as they come.
// Without a choice the page follows the system, also when that changes.
{
  const KEY = "bearing-explorer.theme", LARGER = 1.64  // 11 px are 18
  const root = document.documentElement
  const system = matchMedia("(prefers-color-scheme: dark)")
  const kept = () => { try { return localStorage.getItem(KEY) } catch { return null } }
  const wanted = () => ["light", "dark"].includes(kept()) ? kept() : system.matches ? "dark" : "light"

  // Colours, and lists of colours by what is in them.
  const { colors, palettes } = window.__themes
  const turned = (map) => Object.fromEntries(Object.entries(map).map(([a, b]) => [b.toUpperCase(), a]))
  const tables = {
    dark: { colors, palettes: new Map(palettes.map(([light, dark]) => [light.join(), dark])) },
    light: { colors: turned(colors), palettes: new Map(palettes.map(([light, dark]) => [dark.join(), light])) },
  }
  const recolored = (value) => {
    const { colors, palettes } = tables[theme]
    if (typeof value === "string") return colors[value.toUpperCase()]
    if (!Array.isArray(value)) return
    const items = value.map((item) => typeof item === "string" && colors[item.toUpperCase()])
    return palettes.get(value.join()) ?? (items.length && items.every(Boolean) ? items : undefined)
  }
  const resized = (value, factor) => {
    const [, size, unit] = /^(-?[\d.]+)(px)?$/.exec(value) ?? []
    const changed = size && Math.round(factor * Number(size) * 100) / 100
    return size && (unit ? `${changed}px` : changed)
  }
  // What a property becomes; a value may stand inside of {value: ...}. Undefined where it stays.
  const changed = (value, change) => {
    if (value?.value === undefined || Object.getPrototypeOf(value) !== Object.prototype) return change(value)
    const inner = change(value.value)
    return inner === undefined ? undefined : { ...value, value: inner }
  }

  let theme = wanted(), large = false
  const done = new WeakMap()  // the look of a model: it comes light, and not large
  const COLOR = /(^|_)(color|palette|colors)$/, SIZE = /text_font_size$|^[xy]_offset$/
  const ROOM = /^((min_)?height|min_border_(left|right))$/  // of a figure, for its words
  const paint = (model) => {
    const was = done.get(model) ?? { theme: "light", large: false }
    if (was.theme === theme && was.large === large) return
    done.set(model, { theme, large })
    const changes = {}
    for (const property of model) {
      if (property.is_unset) continue
      let value
      if (was.theme !== theme && COLOR.test(property.attr)) value = changed(property.get_value(), recolored)
      if (was.large !== large && (SIZE.test(property.attr) || (model.type === "Figure" && ROOM.test(property.attr))))
        value = changed(property.get_value(), (size) => resized(size, large ? LARGER : 1 / LARGER))
      if (value !== undefined) changes[property.attr] = value
    }
    if (model.type === "ColumnDataSource" && was.theme !== theme)
      for (const [column, items] of Object.entries(model.data))
        if (COLOR.test(column) && Array.isArray(items))
          model.data[column] = items.map((item) => changed(item, recolored) ?? item)
    if (Object.keys(changes).length) model.setv(changes, { sync: false })
  }
  const followed = new WeakSet()
  const documents = () => window.Bokeh?.documents ?? []
  const paint_all = () => {
    for (const doc of documents()) {
      for (const model of doc.all_models) paint(model)
      if (followed.has(doc)) continue
      followed.add(doc)
      let known = doc.all_models.size, waiting = false
      doc.on_change(() => {
        const as_it_comes = theme === "light" && !large
        if (as_it_comes || waiting || doc.all_models.size === known) return
        waiting = true
        queueMicrotask(() => {
          waiting = false
          known = doc.all_models.size
          for (const model of doc.all_models) paint(model)
        })
      })
    }
  }
  const show = (next) => {
    root.dataset.theme = theme = next
    paint_all()
    // colours that come out of a mapper are worked out with the numbers
    for (const doc of documents())
      for (const model of doc.all_models)
        if (model.type === "GlyphRenderer") model.data_source.change.emit()
    window.dispatchEvent(new CustomEvent("explorer-theme", { detail: theme }))
  }
  root.dataset.theme = theme
  system.addEventListener("change", () => { if (wanted() !== theme) show(wanted()) })
  window.addEventListener("explorer-turn-theme", () => {
    const next = theme === "dark" ? "light" : "dark"
    try { localStorage.setItem(KEY, next) } catch { /* for this page only */ }
    show(next)
  })
  window.addEventListener("explorer-projector", ({ detail }) => {
    large = detail
    root.toggleAttribute("data-projector", large)
    queueMicrotask(paint_all)  // after all who listen: page.js gives fitted figures their own size back
  })
  window.addEventListener("explorer-figures", paint_all)  // the documents are there
}
