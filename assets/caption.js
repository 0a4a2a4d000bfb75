// Head of a view: title, what it shows, and the numbers behind it as a file.
export function render({ model }) {
  const head = document.createElement("header")
  const words = document.createElement("div")
  const title = document.createElement("h2")
  const about = document.createElement("p")
  const save = document.createElement("button")
  title.textContent = model.title
  about.textContent = model.about
  save.type = "button"
  save.textContent = "CSV"
  save.title = `Save the numbers of this figure (${model.file_name})`
  save.setAttribute("aria-label", `Save the numbers of “${model.title}” as CSV`)
  save.addEventListener("click", () => model.send_msg("csv"))
  model.on("msg:custom", (message) => {
    const link = document.createElement("a")
    link.href = URL.createObjectURL(new Blob([message.csv], { type: "text/csv" }))
    link.download = model.file_name
    link.click()
    setTimeout(() => URL.revokeObjectURL(link.href), 10000)
  })
  words.append(title, about)
  head.append(words, save)
  return head
}
