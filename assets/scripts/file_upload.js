// A file, chosen or dropped, sent in pieces: the server asks for each by its first byte.
export function render({ model }) {
  const file = element("input", { type: "file", id: "measurement-file", "aria-describedby": "measurement-note" })
  const choose = element("label", { for: "measurement-file" }, "Choose a file …")
  const bar = element("progress", { "aria-label": "Upload", max: "1", value: "0" })
  const root = element("div", { class: "upload" },
    element("div", { class: "line" }, file, choose, bar),
    element("p", { id: "measurement-note" }, model.note))
  let source = null, upload = 0
  const show = (share) => { bar.hidden = !source; bar.value = share }
  const begin = (chosen) => {
    if (!chosen) return
    source = chosen.size <= model.largest ? chosen : null
    show(0)
    model.send_msg({ type: "begin", name: chosen.name, size: chosen.size })
  }
  model.on("msg:custom", async ({ first, of }) => {
    if (of < upload || !source) return  // about a file that was given up
    upload = of
    const sent = source
    let piece
    try {
      piece = await sent.slice(first, first + model.piece).arrayBuffer()
    } catch {
      piece = new ArrayBuffer(0)  // the file is gone or may not be read: the server says so
    }
    if (sent !== source) return
    const last = first + piece.byteLength
    if (!piece.byteLength || last >= sent.size) source = null
    show(last / sent.size)
    model.send_msg({ type: "piece", content: piece, of })
  })
  file.addEventListener("change", () => {
    begin(file.files[0])
    file.value = ""  // so that the same file can be chosen again
  })
  for (const kind of ["dragover", "dragleave", "drop"]) root.addEventListener(kind, (event) => {
    event.preventDefault()
    root.classList.toggle("over", kind === "dragover")
    if (kind === "drop") begin(event.dataTransfer?.files[0])
  })
  show(0)
  return root
}
