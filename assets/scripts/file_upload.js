// Files, chosen or dropped, sent one after the other in pieces: the server asks for each piece by its
// first byte, and for the next file once it has read one.
// The name of the last file stays in this tab of the browser, to say after a reload that it is gone.
const stored = () => {
  try { return sessionStorage.getItem("signal-files") || "" } catch { return "" }
}
const TREND = 500  // px: the least height of its card with figures
// Documents and pictures that people keep beside their records, as `diagnose` of a folder knows them.
const no_record = /^(readme|licen[cs]e)(\.(txt|rst))?$|\.(md|rst|pdf|docx?|pptx?|html?|py|ipynb|png|jpe?g|svg)$/i
const store = (name) => {
  window.signal_files = name
  try { sessionStorage.setItem("signal-files", name) } catch { /* a browser that stores nothing */ }
}

export function render({ model }) {
  const input = (id, more) => element("input", { type: "file", id, "aria-describedby": "measurement-note", ...more })
  const files = input("measurement-file", { multiple: "" })
  const folder = input("measurement-folder", { webkitdirectory: "" })
  const lost = window.signal_files ? "" : stored()
  const note = element("p", { class: "lost", role: "status" },
    lost && `The page was loaded again: ${lost}, and what was said of it, is not kept. Choose it again.`)
  note.hidden = !lost
  const bar = element("progress", { "aria-label": "Upload", max: "1", value: "0" })
  const root = element("div", { class: "upload" },
    element("div", { class: "line" },
      files, element("label", { for: files.id }, "Choose a file …"),
      folder, element("label", { for: folder.id, class: "further" }, "or a folder …"), bar),
    note,
    element("p", { id: "measurement-note" }, model.note))
  const { compare } = new Intl.Collator(undefined, { numeric: true })
  const place = (file) => file.webkitRelativePath || file.name
  let queue = [], count = 0, chosen = 0, source = null, upload = 0, asked = false
  const show = (share) => {
    bar.hidden = !source && !queue.length
    bar.value = count ? (count - queue.length - 1 + share) / count : 0
  }
  const next = () => {
    const file = queue.shift()
    if (!file) return
    source = file.size <= model.largest ? file : null
    show(0)
    model.send_msg({ type: "begin", name: file.name, size: file.size, number: count - queue.length, count, chosen })
  }
  // The trend that further files bring is far below: it comes into view with its figures.
  const show_trend = () => {
    const card = [...inside(document)].find((one) => one.matches(".view-trend"))
    const growth = new ResizeObserver(([{ contentRect }]) => {
      if (contentRect.height < TREND) return
      growth.disconnect()
      card.scrollIntoView()
    })
    if (card) growth.observe(card)
  }
  const begin = (list) => {
    if (asked) show_trend()
    asked = false
    const all = [...list ?? []].filter(({ name }, _, every) =>
      !name.startsWith(".") && (every.length < 2 || !no_record.test(name)))
    if (all.length === 1 && is_scene_name(all[0].name)) return announce("other-file", { file: all[0], is: "scene" })
    announce("done")
    all.sort((one, other) => compare(place(one), place(other)))
    chosen = all.length
    count = Math.min(chosen, model.most)
    // of more files than are taken some from first to last
    if (chosen) store(chosen > 1 ? `the signal of ${chosen} files` : all[0].name)
    note.hidden = true
    queue = all.filter((_, k) => count === chosen || Math.floor(k * (count - 1) / (chosen - 1)) !== Math.floor((k - 1) * (count - 1) / (chosen - 1)))
    next()
  }
  model.on("msg:custom", async ({ first, of, more }) => {
    if (more) return next()
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
  on_event("choose-files", root, () => {
    asked = true
    files.click()
  })
  for (const chooser of [files, folder]) chooser.addEventListener("change", () => {
    begin(chooser.files)
    chooser.value = ""  // so that the same can be chosen again
  })
  for (const kind of ["dragover", "dragleave", "drop"]) root.addEventListener(kind, (event) => {
    event.preventDefault()
    root.classList.toggle("over", kind === "dragover")
    if (kind === "drop") begin(event.dataTransfer?.files)
  })
  on_event("signal-file", root, ({ file, taken }) => {
    taken()
    begin([file])
  })
  show(0)
  setTimeout(() => announce("upload-ready"), 0)  // once it is on the page
  return root
}
