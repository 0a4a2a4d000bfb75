// Bearings by designation: search, take one, add a table. rows.js is put in front of this file.

const MOST_LISTED = 60
const LARGEST_TABLE = 1e6  // bytes

export function render({ model }) {
  const panel = make_rows(model)
  const search = element("input", { type: "search", id: "bearing-search", autocomplete: "off",
    placeholder: "designation, maker, number of balls …" })
  const count = element("p", { class: "note", role: "status" })
  const list = element("ul", { class: "bearings", tabindex: "0", "aria-label": "Bearings" })
  const refusal = element("p", { class: "refusal", role: "alert" })
  const refuse = (sentence = "") => {
    refusal.textContent = sentence
    refusal.hidden = !sentence
  }
  const entry = ({ name, words, note, assumed, own }) => {
    const use = () => {
      refuse()
      panel.send({ choose: { bearing: name } })
    }
    return element("li", {},
      element("div", { class: "what" },
        element("strong", {}, name, ...(own ? [element("span", { class: "own" }, "yours")] : [])),
        element("span", {}, words)),
      button("Use", use, { "aria-label": `Use ${name}` }),
      ...(note ? [element("p", {}, note)] : []),
      ...(assumed ? [element("p", { class: "assumed" }, `Assumed: ${assumed}.`)] : []))
  }
  const show = () => {
    const words = search.value.toLowerCase().split(/\s+/)
    const found = model.entries.filter((one) => {
      const text = `${one.name} ${one.words} ${one.note}`.toLowerCase()
      return words.every((word) => text.includes(word))
    })
    list.replaceChildren(...found.slice(0, MOST_LISTED).map(entry))
    count.textContent = found.length === 0 ? "No match. Enter dimensions instead."
      : found.length > MOST_LISTED ? `${found.length} found; the first ${MOST_LISTED} are shown.`
      : `${found.length} of ${model.entries.length}`
  }
  search.addEventListener("input", show)

  const file = element("input", { type: "file", accept: ".csv,.txt,.tsv,text/csv,text/plain", id: "bearing-file",
    "aria-describedby": "bearing-file-words" })
  const words = element("p", { class: "note", id: "bearing-file-words", role: "status" })
  sends_text(file, LARGEST_TABLE, (...said) => write_note(words, ...said), (catalogue) => panel.send({ catalogue }))
  const template = element("a", { download: model.spec.file,
    href: `data:text/csv;charset=utf-8,${encodeURIComponent(model.spec.template)}` }, "Download CSV template")

  panel.listen(() => refuse())
  model.on("msg:custom", ({ refused }) => { if (refused?.bearing) refuse(refused.bearing) })
  follow(model, ["entries"], show)
  follow(model, ["answer"], () => write_note(words, model.answer.words ?? "", model.answer.bad))
  refuse()
  return element("div", { class: "listed" },
    element("div", {}, element("label", { for: "bearing-search" }, "Search"), search, count, refusal, list),
    element("div", { class: "upload" },
      element("label", { for: "bearing-file" }, `A table of your own (CSV with ${model.spec.needed})`),
      file, template, words))
}
