// A button in a figure that is zoomed: it leads back to the whole figure, and so does Reset (share.js).
const view = Bokeh.index.find_one_by_id(plot.id)
const is_zoomed = ({ start, end, reset_start, reset_end }) => reset_start !== null && (start !== reset_start || end !== reset_end)
const root = document.documentElement
const led = root.dataset.cell && (root.hasAttribute("data-projector") || innerWidth <= 820)  // to a cell, by a lesson
const zoomed = !led && [plot.x_range, plot.y_range].some(is_zoomed)
let button = view?.shadow_el.querySelector(".home")
if (view && zoomed && !button) {
  button = document.createElement("button")
  Object.assign(button, { type: "button", className: "home", textContent: "Whole figure", title: "Back from the zoom; a double click does it too" })
  button.style.cssText = "position: absolute; left: 50%; top: 4px; translate: -50%; z-index: 3; padding: 6px 10px; " +
    "font: 600 12px/1 var(--font); color: var(--card); background: var(--accent); border: 0; border-radius: 6px; cursor: pointer"
  button.addEventListener("click", () => plot.reset.emit())
  view.shadow_el.append(button)
}
if (button) button.style.display = zoomed ? "" : "none"
