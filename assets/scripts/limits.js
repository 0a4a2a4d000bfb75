// Warnings: the first limit that is exceeded in a line, and a table of all limits on demand.
// Screen readers get a sentence for each that is exceeded.
const STATES = { crossed: "exceeded", kept: "passed", unknown: "not checked" }

export function render({ model }) {
  const warnings = element("div", { class: "warnings", role: "status" })
  const more = element("button", { type: "button", "aria-controls": "limits-list" })
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
  let written = null
  const write = () => {
    const crossed = model.rows.filter(({ state }) => state === "crossed")
    const text = crossed.map(({ sentence }) => sentence).join("\n")
    if (text !== written)
      warnings.replaceChildren(...crossed.map(({ sentence }) => element("p", { title: sentence }, sentence)))
    written = text
    strip.dataset.crossed = String(crossed.length)
    // beside the status line where all is well, a line of its own where it is not
    strip.getRootNode().host?.closest("footer")?.toggleAttribute("data-crossed", crossed.length > 0)
    // where there is little room, the first count alone
    const [first, ...others] = model.summary.split(", ")
    const [count, word, ...how] = first.split(" ")
    more.replaceChildren(`${count} `, element("span", { class: "word" }, `${word} `), how.join(" "),
      element("span", { class: "rest" }, ["", ...others].join(", ")),
      element("span", { class: "help", "aria-hidden": "true" }, "?"))
    more.setAttribute("aria-label", model.summary)
    if (!list.hidden) fill()
  }
  for (const name of ["rows", "summary"]) model.on(name, write)
  requestAnimationFrame(write)  // when it stands on the page
  return strip
}
