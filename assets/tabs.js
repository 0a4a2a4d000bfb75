// Tabs. Arrow keys move between them, as people who use the keyboard expect.
export function render({ model }) {
  const list = document.createElement("div")
  list.setAttribute("role", "tablist")
  list.setAttribute("aria-label", "What to look at")
  const tabs = model.names.map(([name, title]) => {
    const tab = document.createElement("button")
    tab.type = "button"
    tab.textContent = title
    tab.className = `tab-${name}`
    tab.dataset.name = name
    tab.setAttribute("role", "tab")
    tab.addEventListener("click", () => show(name, true))
    return tab
  })
  const show = (name, ask) => {
    for (const tab of tabs) {
      const chosen = tab.dataset.name === name
      tab.setAttribute("aria-selected", String(chosen))
      tab.tabIndex = chosen ? 0 : -1
    }
    if (ask) model.send_msg({ show: name })
  }
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key]
    if (!step) return
    const at = tabs.findIndex((tab) => tab.getAttribute("aria-selected") === "true")
    const next = tabs[(at + step + tabs.length) % tabs.length]
    next.focus()
    next.click()
  })
  list.append(...tabs)
  model.on("active", () => show(model.active, false))
  show(model.active, false)
  return list
}
