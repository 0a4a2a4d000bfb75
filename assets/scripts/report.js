// The second half of a report: its figures are drawn out of sight, as SVG, and put in their places.

const REPORT_WIDTH = 960

async function make_report({ name, html, item, packet, figures }) {
  const place = document.createElement("div")
  place.setAttribute("aria-hidden", "true")
  place.inert = true
  place.style.cssText = `position: fixed; left: -20000px; top: 0; width: ${REPORT_WIDTH}px`
  document.body.append(place)
  const wait = (ms) => new Promise((done) => setTimeout(done, ms))
  const { __frames: frames, __mark: mark } = window
  const manager = await window.Bokeh.embed.embed_item(item, place)
  const roots = [...manager]
  try {
    const { document: drawn } = roots[0].model
    await wait(200)
    drawn.get_model_by_id(packet).properties.data.change.emit()
    Object.assign(window, { __frames: frames, __mark: mark })  // those of the page itself
    await wait(300)
    let page = html
    for (const [i, id] of figures.entries()) {
      const view = manager.find_one_by_id(id)
      const shown = view && view.bbox.width > 0 && view.bbox.height > 0
      const svg = shown ? new XMLSerializer().serializeToString(with_own_ids(svg_of(view), `figure${i}`)) : ""
      page = page.split(`<!--figure ${id}-->`).join(svg)
    }
    save_file(name, page, "text/html")
    return name
  } finally {
    for (const root of roots) {
      const { document: drawn } = root.model
      root.remove()
      const at = window.Bokeh.documents.indexOf(drawn)
      if (at >= 0) window.Bokeh.documents.splice(at, 1)
    }
    place.remove()
  }
}
