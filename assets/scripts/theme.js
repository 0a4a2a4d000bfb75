// Light and dark. Runs before the page is drawn; the styles follow `data-theme` of the root element,
// the figures follow `window.__themes`: which colour of the light page is which of the dark one.
//
// Without a choice the page follows the system, also when that changes. Colours of figures are
// changed in the browser alone, and those of figures that come later as they come.
{
  const KEY = "bearing-explorer.theme"
  const root = document.documentElement
  const system = matchMedia("(prefers-color-scheme: dark)")
  const kept = () => { try { return localStorage.getItem(KEY) } catch { return null } }
  const keep = (theme) => { try { localStorage.setItem(KEY, theme) } catch { /* for this page only */ } }
  const wanted = () => ["light", "dark"].includes(kept()) ? kept() : system.matches ? "dark" : "light"

  // Colours, and lists of colours by what is in them.
  const { colors, palettes } = window.__themes
  const turned = (map) => Object.fromEntries(Object.entries(map).map(([a, b]) => [b.toUpperCase(), a]))
  const name = (list) => list.join()
  const tables = {
    dark: { colors, palettes: new Map(palettes.map(([light, dark]) => [name(light), dark])) },
    light: { colors: turned(colors), palettes: new Map(palettes.map(([light, dark]) => [name(dark), light])) },
  }
  const translated = (value, table) => {
    if (typeof value === "string") return table.colors[value.toUpperCase()]
    if (Array.isArray(value)) {
      const items = value.map((item) => typeof item === "string" && table.colors[item.toUpperCase()])
      return table.palettes.get(name(value)) ?? (items.every(Boolean) && items.length ? items : undefined)
    }
    if (value !== null && typeof value === "object" && typeof value.value === "string"
        && Object.getPrototypeOf(value) === Object.prototype) {
      const inner = translated(value.value, table)
      return inner === undefined ? undefined : { ...value, value: inner }
    }
  }
  let theme = "light"       // what the page is
  const done = new WeakMap() // what a model is: it comes as "light"
  const is_color = /(^|_)(color|palette|colors)$/
  const paint = (model) => {
    if ((done.get(model) ?? "light") === theme) return
    done.set(model, theme)
    const changes = {}
    for (const property of model) {
      if (!is_color.test(property.attr) || property.is_unset) continue
      const value = translated(property.get_value(), tables[theme])
      if (value !== undefined) changes[property.attr] = value
    }
    if (model.type === "ColumnDataSource") paint_data(model)
    if (Object.keys(changes).length) model.setv(changes, { sync: false })
  }
  const paint_data = (source) => {
    const data = source.data
    const columns = Object.keys(data).filter((column) => is_color.test(column)
      && Array.isArray(data[column]) && data[column].some((item) => translated(item, tables[theme])))
    for (const column of columns)
      data[column] = data[column].map((item) => translated(item, tables[theme]) ?? item)
  }
  const followed = new WeakSet()
  const paint_all = () => {
    for (const doc of window.Bokeh?.documents ?? []) {
      for (const model of doc._all_models.values()) paint(model)
      if (followed.has(doc)) continue
      followed.add(doc)
      let known = doc._all_models.size, waiting = false
      doc.on_change(() => {
        if (theme === "light" || waiting || doc._all_models.size === known) return
        waiting = true
        queueMicrotask(() => {
          waiting = false
          known = doc._all_models.size
          for (const model of doc._all_models.values()) paint(model)
        })
      })
    }
  }
  // Bokeh clears a canvas but for half a pixel along two of its edges, where the old paper would
  // stay as a line: all of it is cleared before it is painted in other colours.
  const clear_all = (where) => {
    for (const element of where.querySelectorAll("*")) {
      if (element.shadowRoot) clear_all(element.shadowRoot)
      if (element.localName !== "canvas") continue
      const context = element.getContext("2d")
      if (!context) continue
      context.save()
      context.resetTransform()
      context.clearRect(0, 0, element.width, element.height)
      context.restore()
    }
  }
  const take = (next) => {
    theme = next
    root.dataset.theme = theme
    paint_all()
    clear_all(document.body ?? root)
    // colours that come out of a mapper are worked out with the numbers
    for (const doc of window.Bokeh?.documents ?? [])
      for (const model of doc._all_models.values())
        if (model.type === "GlyphRenderer") model.data_source.change.emit()
    window.dispatchEvent(new CustomEvent("explorer-theme", { detail: theme }))
  }
  root.dataset.theme = theme = wanted()
  system.addEventListener("change", () => { if (wanted() !== theme) take(wanted()) })
  window.explorer_theme = {
    get now() { return theme },
    turn() {
      const next = theme === "dark" ? "light" : "dark"
      keep(next)
      take(next)
    },
    // to be called when the documents are there
    follow: paint_all,
  }
}
