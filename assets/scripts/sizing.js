// Extents that could have given a signal, with their probabilities. To look at one shows its curves.
export function render({ model }) {
  const list = element("ol", { "aria-label": "Candidates for the extent of the defect" })
  let asked = null, timer = 0
  const look = (index) => {
    if (asked === index) return
    asked = index
    clearTimeout(timer)
    timer = setTimeout(() => model.send_msg({ look: index }), 40)  // not for what a pointer crosses
  }
  const row = ({ extent, length, extent_deg, made_of, probability, percent, explains, fitted, truth }, index) => {
    const filled = element("i")
    filled.style.width = `${Math.max(100*probability, 0.4)}%`
    const name = element("span", { class: "extent" }, extent, element("small", {}, length))
    const bar = element("span", { class: "bar" }, filled)
    const mark = truth ? [element("span", { class: "truth" }, `true ${truth}`)] : []
    const seen = element("button", { type: "button", class: "seen", "aria-describedby": `candidate-${index}` },
      name, element("span", { class: "turns" }, made_of), bar, element("span", { class: "percent" }, percent), ...mark)
    const take = element("button", { type: "button", class: "take" }, "Take into scene")
    take.setAttribute("aria-label", `Take ${extent} into the scene`)
    take.addEventListener("click", () => window.dispatchEvent(
      new CustomEvent("explorer-typed", { detail: { extent_deg } })))
    const item = element("li", {}, seen,
      element("span", { class: "details", id: `candidate-${index}` }, explains, element("small", {}, fitted)), take)
    item.addEventListener("pointerenter", () => look(index))
    seen.addEventListener("focus", () => look(index))
    seen.addEventListener("click", () => look(index))
    return item
  }
  const fill = () => {
    asked = null
    list.replaceChildren(...model.rows.map(row))
    list.classList.toggle("known", model.rows.some(({ truth }) => truth))
    mark()
  }
  const mark = () => [...list.children].forEach((item, index) => {
    item.classList.toggle("looked", index === model.looked)
    item.querySelector(".seen").setAttribute("aria-current", String(index === model.looked))
  })
  model.on("rows", fill)
  model.on("looked", mark)
  fill()
  return list
}
