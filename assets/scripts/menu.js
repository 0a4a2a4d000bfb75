const scaled = ({ left, top, bottom }, by) => ({ left: left / by, top: top / by, bottom: bottom / by })

// A popover that opens below its button, which is in the same shadow tree, and closes by Escape or a
// click outside.
function opens_below(opener, panel, widest) {
  opener.setAttribute("aria-expanded", "false")
  opener.addEventListener("click", () => panel.togglePopover({ source: opener }))
  panel.addEventListener("beforetoggle", (event) => {
    opener.setAttribute("aria-expanded", String(event.newState === "open"))
    if (event.newState !== "open") return
    const by = panel.currentCSSZoom ?? 1  // lengths of the panel, for a projector
    const [box, innerWidth, innerHeight] = [scaled(opener.getBoundingClientRect(), by), window.innerWidth / by, window.innerHeight / by]
    const width = Math.min(widest, innerWidth - 16)
    panel.style.width = `${width}px`
    panel.style.left = `${Math.max(8, Math.min(box.left, innerWidth - width - 8))}px`
    const below = innerHeight - box.bottom > 320 || box.top < innerHeight / 2
    panel.style.top = below ? `${box.bottom + 6}px` : "auto"
    panel.style.bottom = below ? "auto" : `${innerHeight - box.top + 6}px`
    panel.style.maxHeight = `${(below ? innerHeight - box.bottom : box.top) - 20}px`
  })
  panel.addEventListener("toggle", (event) => {
    if (event.newState === "open") panel.querySelector("input, button:not([hidden], :disabled)")?.focus()
    else if (panel.contains(panel.getRootNode().activeElement)) opener.focus()
  })
}

// A menu of `items`, buttons: arrow keys move in it, and a choice closes it.
function menu_of(items, attributes) {
  for (const item of items) {
    item.setAttribute("role", "menuitem")
    item.tabIndex = -1
  }
  const menu = element("div", { role: "menu", popover: "auto", ...attributes }, ...items)
  menu.addEventListener("keydown", (event) => {
    if (event.key === "Tab") return menu.hidePopover()
    const shown = items.filter((item) => !item.hidden && !item.disabled)
    const at = shown.indexOf(menu.getRootNode().activeElement)
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 }[event.key]
    if (to === undefined) return
    event.preventDefault()
    shown.at(to % shown.length).focus()
  })
  // before the item acts: a dialog that it opens is then the last to take the focus
  menu.addEventListener("click", () => menu.hidePopover(), true)
  return menu
}
