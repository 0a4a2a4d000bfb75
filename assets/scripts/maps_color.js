// Colour the maps: whole numbers of 16 bits to pixels. See app/bearing_explorer/explorer/views/maps.py. A map is coloured anew
// when the page turns from light to dark.
const numbers = cb_obj
window.__maps_colored ??= new WeakSet()
if (!window.__maps_colored.has(numbers)) {
  window.__maps_colored.add(numbers)
  window.addEventListener("explorer-theme", () => numbers.properties.data.change.emit())
}
const of_theme = (name) => scales instanceof Map ? scales.get(name) : scales[name]
const floats = cb_obj.data.bits
const p = new Uint16Array(floats.buffer, floats.byteOffset, 2*floats.length)
if (p.length > head) {
  const rows = p[0], columns = p[1], levels = p[2 + n]
  const Pixels = images.data.image[0].constructor
  const palettes = of_theme(document.documentElement.dataset.theme ?? "light").map((colors) => Uint32Array.from(colors))
  const maps = [], bars = []
  let at = head
  for (let i = 0; i < n; i++) {
    const kind = p[2 + i], palette = palettes[kind]
    const pixels = new Uint32Array(rows*columns)
    for (let k = 0; k < pixels.length; k++, at++)
      pixels[k] = p[at] === none ? 0 : palette[p[at] >> 8]
    maps.push(new Pixels(pixels.buffer, [rows, columns]))
    const count = kind == 2 ? levels : palette.length
    const bar = Uint32Array.from({length: count}, (_, k) =>
      kind == 3 ? 0 : palette[Math.floor((k + 0.5)*256/count)])
    bars.push(new Pixels(bar.buffer, [count, 1]))
  }
  images.data = {...images.data, image: [...maps, ...bars]}
}
