// Warnings: limits that are exceeded, in short; all limits in a table on demand.
const STATES = { crossed: "exceeded", kept: "passed", unknown: "cannot be checked" }

export function render({ model }) {
  const warnings = element("p", { class: "warnings", role: "status" })
  const more = element("button", { type: "button", "aria-controls": "limits-list", hidden: "" })
  const list = element("div", { class: "list", id: "limits-list" })
  const strip = element("section", { class: "strip", "aria-label": "Limits of the model" }, warnings, more, list)
  const line = (cells, tag = "td") => cells.map((cell) => element(tag, {}, cell))
  const fill = () => list.replaceChildren(element("table", {},
    element("thead", {}, element("tr", {}, ...line(["Check", "Value", "Limit", "", "In words"], "th"))),
    element("tbody", {}, ...model.rows.map(({ name, value, limit, state, sentence }) =>
      element("tr", { "data-state": state }, ...line([name, value, limit, STATES[state], sentence]))))))
  unfolds(more, list, (shown) => {
    more.title = shown ? "Hide the limits" : "Show all limits of the model"
    if (shown) fill()
  })
  const write = () => {
    const crossed = model.rows.filter(({ state }) => state === "crossed")
    const text = crossed.map(({ short }) => short).join("; ")
    if (warnings.textContent !== text) warnings.replaceChildren(...text.split(/(?=; )/).map((one) => element("span", {}, one)))
    strip.dataset.crossed = String(crossed.length)
    // beside the status line where all is well, a line of its own where it is not
    strip.getRootNode().host?.closest("footer")?.toggleAttribute("data-crossed", crossed.length > 0)
    more.hidden = model.rows.length === 0  // before the first picture, and of a measured signal
    const [first, others = ""] = model.summary.split(/(?= \()/)
    const [count, why = ""] = others.replace(/\)$/, "").split(/(?=:)/)
    more.replaceChildren(first, element("span", { class: "others" }, count,
      element("span", { class: "why" }, why), others && ")"))
    if (!list.hidden) fill()
  }
  for (const name of ["rows", "summary"]) model.on(name, write)
  requestAnimationFrame(write)  // when it stands on the page
  return strip
}
