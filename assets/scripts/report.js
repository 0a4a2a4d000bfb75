// The second half of a report: its figures are drawn out of sight, as SVG, and put in their places.

async function make_report({ name, html, items, figures, width }) {
  const place = document.createElement("div")
  place.setAttribute("aria-hidden", "true")
  place.inert = true
  place.style.cssText = `position: fixed; left: -20000px; top: 0; width: ${width}px`
  document.body.append(place)
  const managers = []
  try {
    for (const item of items) {
      const own = place.appendChild(document.createElement("div"))
      managers.push(await window.Bokeh.embed.embed_item(item, own))
    }
    await new Promise((done) => setTimeout(done, 500))
    let page = html
    for (const [i, id] of figures.entries()) {
      const view = managers.map((manager) => manager.find_one_by_id(id)).find((found) => found)
      const shown = view && view.bbox.width > 0 && view.bbox.height > 0
      const svg = shown ? new XMLSerializer().serializeToString(with_own_ids(svg_of(view), `figure${i}`)) : ""
      page = page.split(`<!--figure ${id}-->`).join(svg)
    }
    save_file(name, page, "text/html")
    return name
  } finally {
    for (const root of managers.flatMap((manager) => [...manager])) {
      const { document: drawn } = root.model
      root.remove()
      const at = window.Bokeh.documents.indexOf(drawn)
      if (at >= 0) window.Bokeh.documents.splice(at, 1)
    }
    place.remove()
  }
}
