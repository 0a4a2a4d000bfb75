// Figures as files, out of what is on screen.

const SVG = "http://www.w3.org/2000/svg"
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity",
               "opacity", "font-family", "font-size", "font-style", "font-weight", "visibility", "transform"]

function set_all(made, attributes) {
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value)
  return made
}

// The views of Bokeh's figures with these ids that have a size now, in the order of the page.
function figures_on_screen(ids) {
  return ids.map((id) => window.Bokeh.index.find_one_by_id(id))
    .filter((view) => view && view.el.getBoundingClientRect().width > 0)
}

// An SVG of the page with the looks that its style sheets give it, in the manner of a view.
function drawing_of(svg) {
  const { width, height } = svg.getBoundingClientRect()
  const draw = () => {
    const copy = set_all(svg.cloneNode(true), { xmlns: SVG, width, height })
    const here = [...svg.querySelectorAll("*")], there = [...copy.querySelectorAll("*")]
    here.forEach((part, i) => {
      const looks = getComputedStyle(part)
      if (looks.display === "none") there[i].remove()
      for (const name of LOOKS) there[i].style.setProperty(name, looks.getPropertyValue(name))
    })
    const fill = getComputedStyle(document.documentElement).getPropertyValue("--card") || "white"
    copy.prepend(set_all(document.createElementNS(SVG, "rect"), { width: "100%", height: "100%", fill }))
    return copy
  }
  return { el: svg, draw }
}

function svg_of(view) {
  if (view.draw) return view.draw()
  const { width, height } = view.bbox
  const svg = view.export("svg", false).ctx.get_svg().cloneNode(true)
  // the lines in the key of compared scenes are bitmaps there, as coarse as the screen
  const key = view.model.above.find((part) => part.items)
  const [w, h] = [key?.glyph_width, key?.glyph_height].map(String)
  const coarse = [...svg.querySelectorAll(`image[width="${w}"][height="${h}"]`)]
  key?.items.filter(({ visible }) => visible).forEach(({ renderers: [{ glyph }] }, i) => {
    const [stroke, wide, dash] = [glyph.line_color, glyph.line_width, glyph.line_dash].map(({ value }) => value)
    coarse[i].replaceWith(set_all(document.createElementNS(SVG, "line"), {
      x2: w, y1: h / 2, y2: h / 2, stroke, "stroke-width": wide, "stroke-dasharray": dash,
      transform: coarse[i].getAttribute("transform") }))
  })
  return set_all(svg, { width, height, viewBox: `0 0 ${width} ${height}` })
}

// Ids within a drawing are its own: several stand in one file.
function with_own_ids(svg, mark) {
  const ids = new Map()
  for (const element of svg.querySelectorAll("[id]")) {
    ids.set(element.id, `${mark}-${element.id}`)
    element.id = ids.get(element.id)
  }
  for (const element of svg.querySelectorAll("*"))
    for (const { name, value } of element.attributes) {
      const renamed = value.replace(/url\(["']?#([^)"']+)["']?\)/g,
        (whole, id) => ids.has(id) ? `url(#${ids.get(id)})` : whole)
      if (renamed !== value) element.setAttribute(name, renamed)
    }
  return svg
}

const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif"
const PAD = 12, LEAST_WIDTH = 420  // px

// Lines of text as SVG, wrapped to a width; returns them and their height.
function text_lines(words, size, color, width, looks = {}) {
  const pen = document.createElement("canvas").getContext("2d")
  pen.font = `${looks["font-weight"] ?? 400} ${size}px ${FONT}`
  const lines = [""]
  for (const word of words.split(/(?<=\s|&)/)) {  // a link is broken before its next part
    const longer = lines.at(-1) + word
    if (lines.at(-1) && pen.measureText(longer.trimEnd()).width > width) lines.push(word)
    else lines[lines.length - 1] = longer
  }
  const step = Math.round(1.35 * size)
  const made = lines.map((line, i) => {
    const text = set_all(document.createElementNS(SVG, "text"),
      { x: PAD, y: size + i * step, "font-size": size, "font-family": FONT, fill: color, ...looks })
    text.textContent = line
    return text
  })
  return { made, height: lines.length * step }
}

// Views as one drawing, placed as on the page. Above are title and key, below the scene and a link.
function drawing_of_all(views, { title, key = "", scene = "", link = "" }) {
  const boxes = views.map((view) => view.el.getBoundingClientRect())
  const left = Math.min(...boxes.map((box) => box.left)), top = Math.min(...boxes.map((box) => box.top))
  const wide = Math.ceil(Math.max(...boxes.map((box) => box.right)) - left)
  const high = Math.ceil(Math.max(...boxes.map((box) => box.bottom)) - top)
  const drawn = views.map(svg_of)
  const width = Math.max(wide + 2 * PAD, LEAST_WIDTH)
  const look = getComputedStyle(document.documentElement)
  const [ink, soft, paper] = ["--ink", "--ink-soft", "--card"].map((name) => look.getPropertyValue(name))
  let height = PAD
  const parts = []
  const put = (words, size, color, looks) => {
    if (!words) return
    const { made, height: own } = text_lines(words, size, color, width - 2 * PAD, looks)
    const group = set_all(document.createElementNS(SVG, "g"), { transform: `translate(0 ${height})` })
    group.append(...made)
    parts.push(group)
    height += own + 3
  }
  put(title, 15, ink, { "font-weight": 620 })
  put(key, 12, soft)
  parts.push(...views.map((_, i) => set_all(with_own_ids(drawn[i], `figure${i}`),
    { x: PAD + boxes[i].left - left, y: boxes[i].top - top + height })))
  height += high + 6
  put(scene, 12, ink)
  put(link, 11, soft)
  height += PAD / 2
  const words = document.createElementNS(SVG, "title")
  words.textContent = title
  const whole = set_all(document.createElementNS(SVG, "svg"),
    { xmlns: SVG, width, height, viewBox: `0 0 ${width} ${height}`, role: "img" })
  const ground = set_all(document.createElementNS(SVG, "rect"), { width: "100%", height: "100%", fill: paper })
  whole.append(words, ground, ...parts)
  return { text: new XMLSerializer().serializeToString(whole), width, height }
}

// Twice as fine as the screen, or as fine as it is where that is finer.
async function figures_as_png(views, about) {
  const { text, width, height } = drawing_of_all(views, about)
  const scale = Math.max(2, window.devicePixelRatio)
  const canvas = Object.assign(document.createElement("canvas"), { width: width * scale, height: height * scale })
  const image = new Image()
  image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }))
  await image.decode()
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height)
  URL.revokeObjectURL(image.src)
  return new Promise((done) => canvas.toBlob(done, "image/png"))
}

function save_file(name, content, type) {
  const link = document.createElement("a")
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }))
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 10000)
}

// Tells whether the clipboard has taken something, of which a picture may still be on its way.
async function is_copied(copy) {
  try {
    await copy(navigator.clipboard)
    return true
  } catch {
    return false  // not allowed, or the page is not served safely: a person can copy by hand
  }
}
const copy_image = (png) => is_copied((clipboard) => clipboard.write([new ClipboardItem({ "image/png": png })]))
const copy_text = (text) => is_copied((clipboard) => clipboard.writeText(text))
