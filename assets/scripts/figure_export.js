// Figures as files, out of what is on screen.

const SVG = "http://www.w3.org/2000/svg"

// The views of Bokeh's figures with these ids that have a size now, in the order of the page.
function figures_on_screen(ids) {
  return ids.map((id) => window.Bokeh.index.find_one_by_id(id))
    .filter((view) => view && view.el.getBoundingClientRect().width > 0)
}

// A drawing that stands on the page as SVG, with the looks that its style sheets give it, in the
// manner of a view.
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity",
               "opacity", "font-family", "font-size", "font-style", "font-weight", "visibility"]
function drawing_of(svg) {
  const { width, height } = svg.getBoundingClientRect()
  const draw = () => {
    const copy = svg.cloneNode(true)
    const here = [...svg.querySelectorAll("*")], there = [...copy.querySelectorAll("*")]
    here.forEach((element, i) => {
      const looks = getComputedStyle(element)
      if (looks.display === "none") there[i].remove()
      for (const name of LOOKS) there[i].style.setProperty(name, looks.getPropertyValue(name))
    })
    const paper = document.createElementNS(SVG, "rect")
    for (const [name, value] of [["width", "100%"], ["height", "100%"]]) paper.setAttribute(name, value)
    paper.style.fill = getComputedStyle(document.documentElement).getPropertyValue("--card") || "white"
    copy.prepend(paper)
    copy.setAttribute("xmlns", SVG)
    copy.setAttribute("width", width)
    copy.setAttribute("height", height)
    return copy
  }
  return { el: svg, draw }
}

// The first element with `selector` below a node, shadows included.
function find_deep(node, selector) {
  const found = node.querySelector(selector)
  if (found) return found
  for (const element of node.querySelectorAll("*")) {
    const deeper = element.shadowRoot && find_deep(element.shadowRoot, selector)
    if (deeper) return deeper
  }
  return null
}

function svg_of(view) {
  if (view.draw) return view.draw()
  const svg = view.export("svg", false).ctx.get_svg().cloneNode(true)
  const { width, height } = view.bbox
  svg.setAttribute("width", width)
  svg.setAttribute("height", height)
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`)
  return svg
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

// Where figures stand beside each other, in one box around them all.
function layout_of(views) {
  const boxes = views.map((view) => view.el.getBoundingClientRect())
  const left = Math.min(...boxes.map((box) => box.left)), top = Math.min(...boxes.map((box) => box.top))
  return {
    places: boxes.map((box) => [box.left - left, box.top - top]),
    width: Math.ceil(Math.max(...boxes.map((box) => box.right)) - left),
    height: Math.ceil(Math.max(...boxes.map((box) => box.bottom)) - top),
  }
}

function figures_as_svg(views, title) {
  const { places, width, height } = layout_of(views)
  const whole = document.createElementNS(SVG, "svg")
  whole.setAttribute("xmlns", SVG)
  whole.setAttribute("width", width)
  whole.setAttribute("height", height)
  whole.setAttribute("viewBox", `0 0 ${width} ${height}`)
  whole.setAttribute("role", "img")
  const words = document.createElementNS(SVG, "title")
  words.textContent = title
  whole.append(words)
  views.forEach((view, i) => {
    const svg = with_own_ids(svg_of(view), `figure${i}`)
    svg.setAttribute("x", places[i][0])
    svg.setAttribute("y", places[i][1])
    whole.append(svg)
  })
  return new XMLSerializer().serializeToString(whole)
}

// Twice as fine as the screen, or as fine as it is where that is finer.
async function figures_as_png(views) {
  const { places, width, height } = layout_of(views)
  const canvas = document.createElement("canvas")
  const scale = Math.max(2, window.devicePixelRatio)
  canvas.width = width*scale
  canvas.height = height*scale
  const context = canvas.getContext("2d")
  context.fillStyle = "white"
  context.fillRect(0, 0, canvas.width, canvas.height)
  context.scale(scale, scale)
  for (const [i, view] of views.entries()) {
    const image = new Image()
    const text = new XMLSerializer().serializeToString(svg_of(view))
    image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }))
    await image.decode()
    context.drawImage(image, ...places[i])
    URL.revokeObjectURL(image.src)
  }
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
