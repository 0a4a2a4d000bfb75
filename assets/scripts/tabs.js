// Tabs in groups, as many rows as they need; where there is little room, a list to choose from.
// Arrow keys move between tabs, as people who use the keyboard expect. Other scripts ask for a tab by
// the event "explorer-show" on the window, with its name; "explorer-asked" says that one is on its
// way, with its name and title, and "explorer-tab" that it stands.
export function render({ model }) {
  const show = (name, ask) => {
    for (const tab of tabs) {
      const chosen = tab.dataset.name === name
      tab.setAttribute("aria-selected", String(chosen))
      tab.tabIndex = chosen ? 0 : -1
    }
    select.value = name
    if (!ask) return
    model.send_msg({ show: name })
    window.dispatchEvent(new CustomEvent("explorer-asked", { detail: { name, title: titles.get(name) } }))
  }
  const titles = new Map(model.names)
  const groups = []
  for (const [name, title, group = ""] of model.names) {
    if (!groups.length || (group && group !== groups.at(-1).group)) groups.push({ group, entries: [] })
    groups.at(-1).entries.push([name, title])
  }
  const tabs = []
  const list = element("div", { class: "list", role: "tablist", "aria-label": "What to look at" },
    ...groups.map(({ group, entries }) => element("div", { class: "group", role: "presentation" },
      element("span", { class: "name", "aria-hidden": "true" }, group),
      ...entries.map(([name, title]) => {
        const tab = element("button", { type: "button", class: `tab-${name}`, role: "tab" }, title)
        tab.dataset.name = name
        tab.addEventListener("click", () => show(name, true))
        tabs.push(tab)
        return tab
      }))))
  const select = element("select", { "aria-label": "What to look at" },
    ...groups.map(({ group, entries }) => {
      const options = entries.map(([name, title]) => element("option", { value: name }, title))
      return group ? element("optgroup", { label: group }, ...options) : options
    }).flat())
  select.addEventListener("change", () => show(select.value, true))

  list.addEventListener("keydown", (event) => {
    const at = tabs.findIndex((tab) => tab.getAttribute("aria-selected") === "true")
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key]
    if (to === undefined) return
    event.preventDefault()
    const next = tabs[(to + tabs.length) % tabs.length]
    next.focus()
    next.click()
  })
  const root = document.documentElement
  const stands = () => {
    show(model.active, false)
    root.dataset.tab = model.active
    window.dispatchEvent(new CustomEvent("explorer-tab", { detail: model.active }))
  }
  model.on("active", stands)
  const asked = (event) => {
    if (!list.isConnected) window.removeEventListener("explorer-show", asked)
    else if (titles.has(event.detail)) show(event.detail, true)
  }
  window.addEventListener("explorer-show", asked)
  stands()
  return element("div", {}, list, select)
}
