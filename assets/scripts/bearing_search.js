// One search over all bearings: presets, published ones, those of a person's table, designations.
// rows.js is put in front of this file. The server finds; what it finds is a list below the field.

const SEARCH_PAUSE = 150  // ms without a key until a text is sent

function bearing_search(model, panel) {
  // what scrolls is a stop of Tab without a tabindex, and this list closes as the field is left
  const list = element("ul", { id: "found-bearings", role: "listbox", "aria-label": "Bearings", tabindex: "-1", hidden: "" })
  const input = element("input", { type: "search", id: "choice-preset", role: "combobox", maxlength: "60",
    autocomplete: "off", spellcheck: "false", "aria-autocomplete": "list", "aria-expanded": "false",
    "aria-controls": "found-bearings", placeholder: "6208-2RS/C3, NU 208, 0.235 in \u2026" })
  const status = element("p", { class: "note", role: "status" })
  const refusal = element("p", { class: "refusal", role: "alert", hidden: "" })
  const note = element("p", { class: "note", id: "note-preset" })
  const more = button("?", () => {}, { class: "info", "aria-controls": "note-preset",
    "aria-label": "About this bearing", title: "About this bearing" })
  unfolds(more, note)
  let name = "", active = -1, pause = 0
  let listed = ""  // the text that the list is of
  let taking = false  // whether Enter came before the list of its text, whose first is then taken

  const typed = () => input.value === name ? "" : input.value.trim().replace(/\s+/g, " ")
  const search = () => model.send_msg({ search: typed() })
  const open = (shown) => {
    list.hidden = !shown
    input.setAttribute("aria-expanded", String(shown))
    if (shown) return
    status.textContent = ""
    point(-1)
  }
  const close = () => {
    clearTimeout(pause)
    taking = false
    input.value = name
    open(false)
  }
  const point = (index) => {
    active = index
    for (const [i, one] of [...list.children].entries()) one.setAttribute("aria-selected", String(i === index))
    const one = list.children[index]
    input.setAttribute("aria-activedescendant", one?.id ?? "")
    one?.scrollIntoView({ block: "nearest" })
  }
  const take = (choose) => {
    refuse("")
    open(false)
    panel.send({ choose })
  }
  const refuse = (sentence) => panel.refuse("preset", sentence)
  const list_found = ({ text, entries, words }) => {
    if (input.getRootNode().activeElement !== input || text !== typed()) return
    list.replaceChildren(...entries.map(({ choose, label, words: about, mark }, i) => {
      const one = element("li", { role: "option", id: `found-${i}`, "aria-selected": "false" },
        element("strong", {}, label, ...(mark ? [element("span", { class: "mark" }, mark)] : [])), about)
      one.addEventListener("click", () => { input.blur(); take(choose) })
      one.take = () => take(choose)
      return one
    }))
    open(entries.length > 0)
    status.textContent = words || `${entries.length} found`
    point(-1)
    listed = text
    if (taking) take_first()
  }
  const take_first = () => {
    taking = false
    if (list.hidden) return
    if (active < 0 && !typed()) return input.blur()  // nothing was typed or pointed at
    list.children[Math.max(active, 0)].take()
    input.blur()
  }
  // the field keeps the focus until the choice is made
  list.addEventListener("pointerdown", (event) => event.preventDefault())
  input.addEventListener("focus", () => { input.select(); search() })
  input.addEventListener("input", () => {
    taking = false
    clearTimeout(pause)
    pause = setTimeout(search, SEARCH_PAUSE)
  })
  input.addEventListener("blur", close)
  input.addEventListener("keydown", (event) => {
    const count = list.children.length
    if (event.key === "Escape") input.blur()
    else if (event.key === "Enter" && listed === typed()) take_first()
    else if (event.key === "Enter") {
      clearTimeout(pause)
      taking = true
      search()
    }
    else if (/^Arrow(Up|Down)$/.test(event.key) && !list.hidden)
      point((active + (event.key === "ArrowDown" ? 1 : count - (active < 0 ? 0 : 1))) % count)
    else return
    event.preventDefault()
  })
  model.on("msg:custom", ({ found, refused }) => {
    if (found) list_found(found)
    if (refused?.bearing) refuse(refused.bearing)
  })
  const follow_state = ({ bearing }) => {
    if (!bearing) return
    name = bearing.name
    note.textContent = bearing.note
    if (input.getRootNode().activeElement !== input) input.value = name
  }
  const show = (_, effect = "") => {
    refuse("")
    if (list.hidden) status.textContent = effect
  }
  const root = element("div", { class: "choice choice-preset" },
    element("div", { class: "head" }, element("label", { for: "choice-preset" }, "Bearing"), more),
    element("div", { class: "search" }, input, list), status, refusal, note)
  return { root, refusal, select: input, show, follow_state }
}
