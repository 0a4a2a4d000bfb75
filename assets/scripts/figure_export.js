// Figures as files, out of what is on screen.

const SVG = "http://www.w3.org/2000/svg"
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity",
               "opacity", "font-family", "font-size", "font-style", "font-weight", "visibility"]

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

// The first element with `selector` below a node, shadows included.
function find_deep(node, selector) {
  const found = node.querySelector(selector)
  if (found) return found
  for (const part of node.querySelectorAll("*")) {
    const deeper = part.shadowRoot && find_deep(part.shadowRoot, selector)
    if (deeper) return deeper
  }
  return null
}

function svg_of(view) {
  if (view.draw) return view.draw()
  const { width, height } = view.bbox
  const svg = view.export("svg", false).ctx.get_svg().cloneNode(true)
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

// Views as one drawing, placed as on the page, with its size.
function drawing_of_all(views, title = "") {
  const boxes = views.map((view) => view.el.getBoundingClientRect())
  const left = Math.min(...boxes.map((box) => box.left)), top = Math.min(...boxes.map((box) => box.top))
  const width = Math.ceil(Math.max(...boxes.map((box) => box.right)) - left)
  const height = Math.ceil(Math.max(...boxes.map((box) => box.bottom)) - top)
  const words = document.createElementNS(SVG, "title")
  words.textContent = title
  const whole = set_all(document.createElementNS(SVG, "svg"),
    { xmlns: SVG, width, height, viewBox: `0 0 ${width} ${height}`, role: "img" })
  whole.append(words, ...views.map((view, i) => set_all(with_own_ids(svg_of(view), `figure${i}`),
    { x: boxes[i].left - left, y: boxes[i].top - top })))
  return { text: new XMLSerializer().serializeToString(whole), width, height }
}

const figures_as_svg = (views, title) => drawing_of_all(views, title).text

// Twice as fine as the screen, or as fine as it is where that is finer.
async function figures_as_png(views) {
  const { text, width, height } = drawing_of_all(views)
  const scale = Math.max(2, window.devicePixelRatio)
  const canvas = Object.assign(document.createElement("canvas"), { width: width * scale, height: height * scale })
  const context = canvas.getContext("2d")
  context.fillStyle = "white"
  context.fillRect(0, 0, canvas.width, canvas.height)
  const image = new Image()
  image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }))
  await image.decode()
  context.drawImage(image, 0, 0, canvas.width, canvas.height)
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

async function copy_text(text) {
  try {
    await navigator.clipboard.writeText(text)
    return true
  } catch {
    return false  // not allowed, or the page is not served safely: a person can copy by hand
  }
}
