// Large type and fewer controls, for a projector. Styles follow `data-projector` of the root element;
// the type of figures is enlarged in the browser alone, also of figures that come later.
{
  const LARGER = 1.3
  const root = document.documentElement
  const done = new WeakMap()  // what a model has become: it comes as 1
  let on = false
  const larger = (value, factor) => {
    const found = typeof value === "string" ? /^([\d.]+)px$/.exec(value) : null
    if (found) return `${Math.round(factor * Number(found[1]) * 100) / 100}px`
    if (value !== null && typeof value === "object" && typeof value.value === "string"
        && Object.getPrototypeOf(value) === Object.prototype) {
      const inner = larger(value.value, factor)
      return inner === undefined ? undefined : { ...value, value: inner }
    }
  }
  const size = (model) => {
    const wanted = on ? LARGER : 1
    const factor = wanted / (done.get(model) ?? 1)
    if (factor === 1) return
    done.set(model, wanted)
    const changes = {}
    for (const property of model) {
      if (!/text_font_size$/.test(property.attr) || property.is_unset) continue
      const value = larger(property.get_value(), factor)
      if (value !== undefined) changes[property.attr] = value
    }
    if (Object.keys(changes).length) model.setv(changes, { sync: false })
  }
  const followed = new WeakSet()
  const size_all = () => {
    for (const doc of window.Bokeh?.documents ?? []) {
      for (const model of doc._all_models.values()) size(model)
      if (followed.has(doc)) continue
      followed.add(doc)
      let known = doc._all_models.size
      doc.on_change(() => {
        if (!on || doc._all_models.size === known) return
        known = doc._all_models.size
        queueMicrotask(() => { for (const model of doc._all_models.values()) size(model) })
      })
    }
  }
  window.explorer_projector = {
    get on() { return on },
    turn(wanted = !on) {
      on = wanted
      root.toggleAttribute("data-projector", on)
      size_all()
      window.dispatchEvent(new CustomEvent("explorer-projector", { detail: on }))
    },
  }
}
