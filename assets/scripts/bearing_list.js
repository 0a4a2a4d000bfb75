// Bearings by designation: search, take one, add a table. rows.js is put in front of this file.

const MOST_LISTED = 60
const LARGEST_TABLE = 1e6  // bytes

export function render({ model }) {
  const panel = make_rows(model)
  const search = element("input", { type: "search", id: "bearing-search", autocomplete: "off",
    placeholder: "designation, maker, number of balls …" })
  const count = element("p", { class: "note", role: "status" })
  const list = element("ul", { class: "bearings", tabindex: "0", "aria-label": "Bearings" })
  const refusal = element("p", { class: "refusal", role: "alert", hidden: "" })
  const entry = ({ name, words, note, assumed, own }) => {
    const use = element("button", { type: "button", "aria-label": `Use ${name}` }, "Use")
    use.addEventListener("click", () => {
      refusal.hidden = true
      panel.send({ choose: { bearing: name } })
    })
    const title = element("strong", {}, name)
    if (own) title.append(element("span", { class: "own" }, "yours"))
    const made = element("li", {}, element("div", { class: "what" }, title, element("span", {}, words)), use)
    if (note) made.append(element("p", {}, note))
    if (assumed) made.append(element("p", { class: "assumed" }, `Assumed: ${assumed}.`))
    return made
  }
  const show = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
    const fits = model.entries.filter((one) => {
      const text = `${one.name} ${one.words} ${one.note}`.toLowerCase()
      return words.every((word) => text.includes(word))
    })
    list.replaceChildren(...fits.slice(0, MOST_LISTED).map(entry))
    count.textContent = fits.length === 0 ? "No match. Enter dimensions instead."
      : fits.length > MOST_LISTED ? `${fits.length} fit; shown are the first ${MOST_LISTED}.`
      : `${fits.length} of ${model.entries.length}`
  }
  search.addEventListener("input", show)

  const file = element("input", { type: "file", accept: ".csv,.txt,.tsv,text/csv,text/plain", id: "bearing-file",
    "aria-describedby": "bearing-file-words" })
  const words = element("p", { class: "note", id: "bearing-file-words", role: "status" })
  const say = (sentence, bad = false) => {
    words.textContent = sentence
    words.classList.toggle("bad", bad)
  }
  file.addEventListener("change", async () => {
    const chosen = file.files[0]
    if (!chosen) return
    if (chosen.size > LARGEST_TABLE) say(`${chosen.name} is larger than ${LARGEST_TABLE / 1e6} MB.`, true)
    else {
      say(`Reading ${chosen.name} …`)
      panel.send({ catalogue: { name: chosen.name, text: await chosen.text() } })
    }
    file.value = ""
  })
  const example = element("a", { download: model.spec.file,
    href: `data:text/csv;charset=utf-8,${encodeURIComponent(model.spec.template)}` }, "Download CSV template")
  const upload = element("div", { class: "upload" },
    element("label", { for: "bearing-file" }, `A table of your own (CSV with ${model.spec.needed})`),
    file, example, words)

  panel.listen(() => { refusal.hidden = true })
  model.on("msg:custom", ({ refused }) => {
    if (!refused?.bearing) return
    refusal.textContent = refused.bearing
    refusal.hidden = false
  })
  model.on("entries", show)
  model.on("answer", () => say(model.answer.words, model.answer.bad))
  show()
  if (model.answer.words) say(model.answer.words, model.answer.bad)
  return element("div", { class: "listed" },
    element("div", {}, element("label", { for: "bearing-search" }, "Search"), search, count, refusal, list),
    upload)
}
