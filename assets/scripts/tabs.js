// Tabs in groups, as many rows as they need; where there is little room, a list to choose from.
// Arrow keys move between tabs. Events: "show" asks for a tab by its name, "asked" tells that one is
// on its way (name and title), "tab" that it is open.
export function render({ model }) {
  const titles = new Map(model.names), tabs = [], groups = []
  for (const [name, title, group = ""] of model.names) {
    if (!groups.length || (group && group !== groups.at(-1).group)) groups.push({ group, entries: [] })
    groups.at(-1).entries.push([name, title])
  }
  const show = (name) => {
    for (const tab of tabs) {
      const chosen = tab.dataset.name === name
      tab.setAttribute("aria-selected", String(chosen))
      tab.tabIndex = chosen ? 0 : -1
    }
    select.value = name
  }
  const choose = (name) => {
    show(name)
    model.send_msg({ show: name })
    announce("asked", { name, title: titles.get(name) })
  }
  const list = element("div", { class: "list", role: "tablist", "aria-label": "Views" },
    ...groups.map(({ group, entries }) => element("div", { class: "group", role: "presentation" },
      element("span", { class: "name", "aria-hidden": "true" }, group),
      ...entries.map(([name, title]) => {
        tabs.push(button(title, () => choose(name), { class: `tab-${name}`, role: "tab", "data-name": name }))
        return tabs.at(-1)
      }))))
  const select = element("select", { "aria-label": "Views" },
    ...groups.flatMap(({ group, entries }) => {
      const options = entries.map(([name, title]) => element("option", { value: name }, title))
      return group ? element("optgroup", { label: group }, ...options) : options
    }))
  select.addEventListener("change", () => choose(select.value))
  list.addEventListener("keydown", (event) => {
    const at = tabs.findIndex((tab) => tab.tabIndex === 0)
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key]
    if (to === undefined) return
    event.preventDefault()
    const next = tabs[(to + tabs.length) % tabs.length]
    next.focus()
    next.click()
  })
  follow(model, ["active"], () => {
    show(model.active)
    document.documentElement.dataset.tab = model.active
    announce("tab", model.active)
  })
  on_event("show", list, (name) => { if (titles.has(name)) choose(name) })
  return element("div", {}, list, select)
}
