// The tabs; where there is little room, a list to choose from. A tab with several sections has their
// names behind all tabs while it is open. Arrow keys move between tabs. Events: "show" asks for a section
// by its name, "asked" tells that one is on its way (name and title), "tab" that it is open.
export function render({ model }) {
  const titles = new Map(), groups = []
  for (const [name, title, tab] of model.names) {
    if (groups.at(-1)?.tab !== tab) groups.push({ tab, entries: [] })
    groups.at(-1).entries.push([name, title])
    titles.set(name, tab === title ? title : `${tab}: ${title}`)
  }
  const choose = (name) => {
    show(name)
    model.send_msg({ show: name })
    announce("asked", { name, title: titles.get(name) })
  }
  const tabs = groups.map(({ tab, entries }) => {
    const names = entries.map(([name]) => name)
    const own = { names, last: names[0], parts: [] }
    own.button = button(tab, () => choose(own.last), { class: `tab-${names[0]}`, role: "tab" })
    if (names.length > 1)
      own.parts = entries.map(([name, title]) => button(title, () => choose(name), { class: `part-${name}`, "data-name": name }))
    own.box = element("div", { class: "parts", role: "group", "aria-label": tab, hidden: "" }, ...own.parts)
    return own
  })
  const show = (open) => {
    for (const tab of tabs) {
      const chosen = tab.names.includes(open)
      if (chosen) tab.last = open
      tab.button.setAttribute("aria-selected", String(chosen))
      tab.button.tabIndex = chosen ? 0 : -1
      tab.box.hidden = !chosen || !tab.parts.length
      for (const part of tab.parts) part.setAttribute("aria-pressed", String(part.dataset.name === open))
    }
    select.value = open
  }
  const list = element("div", { class: "list", role: "tablist", "aria-label": "Views" },
    ...tabs.map((tab) => tab.button))
  const options = [...titles].map(([name, title]) => element("option", { value: name }, title))
  const select = element("select", { "aria-label": "Views" }, ...options)
  select.addEventListener("change", () => choose(select.value))
  list.addEventListener("keydown", (event) => {
    const at = tabs.findIndex((tab) => tab.button === event.target)
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key]
    if (to === undefined || at < 0) return
    event.preventDefault()
    const next = tabs[(to + tabs.length) % tabs.length].button
    next.focus()
    next.click()
  })
  follow(model, ["active"], () => {
    show(model.active)
    document.documentElement.dataset.tab = model.active
    announce("tab", model.active)
  })
  on_event("show", list, (name) => { if (titles.has(name)) choose(name) })
  return element("div", { class: "tabs" }, list, ...tabs.map((tab) => tab.box), select)
}
