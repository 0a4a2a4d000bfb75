// What speaks for damage of each part, as a table; a harmonic is a button that zooms to its line.
export function render({ model }) {
  const zoom = (part, harmonic) => model.send_msg({ zoom: [part, harmonic] })
  const body = element("tbody")
  const heads = element("tr")
  const table = element("table", {}, element("caption", {}, "Evidence for each part"), element("thead", {}, heads), body)
  const root = element("div", { class: "rows", tabindex: "0", role: "region", "aria-label": "Evidence for each part" }, table)
  const small = (text) => element("small", {}, text)
  const cell = (main, below = "") => element("td", {}, main, ...(below ? [small(below)] : []))

  const row = (one) => {
    const swatch = element("i", { class: "swatch" })
    swatch.style.background = one.color
    const harmonics = one.harmonics.map(({ order, level, clear }) => {
      const button = element("button", { type: "button", class: clear ? "line clear" : "line",
        "aria-label": `${one.part}, harmonic ${order}: ${level} decibels${clear ? ", clear of noise" : ""}; zoom to it` }, level)
      button.dataset.line = `${one.part} ${order}`
      button.addEventListener("click", () => zoom(one.part, order))
      return element("td", { class: "harmonic" }, button)
    })
    return element("tr", { class: one.leads ? "leads" : "" },
      element("th", { scope: "row" }, swatch, one.part, small(one.name)),
      cell(one.order, `of ${one.nominal}`), cell(one.frequency, one.slip), ...harmonics,
      cell(one.together, `noise ${one.noise}`), cell(one.sidebands, one.spacing),
      cell(one.band, `along ${one.direction}`), cell(one.chance))
  }
  const fill = () => {
    const count = model.rows[0]?.harmonics.length ?? 0
    const names = [["Part"], ["Order", "of geometry's"], ["Line", "slip"],
      ...Array.from({ length: count }, (_, k) => [`${k + 1}×`, k ? "" : "dB"]),
      ["Together", "dB"], ["Sidebands", "dB"], ["Heard in"], ["By chance"]]
    heads.replaceChildren(...names.map(([words, below = ""]) =>
      element("th", { scope: "col" }, words, ...(below ? [small(below)] : []))))
    body.replaceChildren(...model.rows.map(row))
    root.hidden = !model.rows.length
    mark()
  }
  const mark = () => {
    for (const button of body.querySelectorAll("button"))
      button.setAttribute("aria-pressed", String(button.dataset.line === model.looked))
  }
  model.on("rows", fill)
  model.on("looked", mark)
  fill()
  return root
}
