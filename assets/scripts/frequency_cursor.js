// A cursor with harmonics and sidebands in a spectrum. See app/bearing_explorer/diagnosis/views/frequency_view.py.
// `lines.tags` holds the cursor's frequency [Hz], so that it stays when the axis changes.
const SIDES = 3, MOST = 60
const {shaft, cage, hertz} = turning.data
const {frequency, amplitude} = curve.data
const draw = (at) => {
  const found = {at: [], main: [], dash: [], alpha: []}
  lines.tags = []
  if (at !== null && hertz.length) {
    lines.tags = [at*hertz[0]]
    const spacing = [0, shaft[0], cage[0]][buttons.active]
    const last = frequency[frequency.length - 1]
    const add = (x, main) => {
      if (!(x > 0 && x <= last)) return
      found.at.push(x); found.main.push(main)
      found.dash.push(main ? "solid" : "dotted"); found.alpha.push(main ? 0.9 : 0.65)
    }
    for (let k = 1; k <= MOST && k*at <= last; k++) {
      add(k*at, 1)
      if (spacing) for (let n = 1; n <= SIDES; n++) { add(k*at - n*spacing, 0); add(k*at + n*spacing, 0) }
    }
  }
  lines.data = found
  if (at === null) { reading.text = hint; return }
  let nearest = 0
  frequency.forEach((f, i) => { if (Math.abs(f - at) < Math.abs(frequency[nearest] - at)) nearest = i })
  const [, unit] = /\(([^)]*(?:\([^)]*\))*[^)]*)\)$/.exec(plot.left[0].axis_label) ?? [null, ""]
  const height = `${rounded(amplitude[nearest], 3)} ${unit}`
  const order = shaft[0] > 0 ? `order ${rounded(at/shaft[0], 4)}, ` : ""  // of a known shaft speed
  reading.text = `<b>${rounded(at*hertz[0], 5)} Hz</b>, ${order}${height}`
}
if (cb_obj.sx === undefined) {  // other numbers, or other sidebands
  draw(lines.tags.length && hertz.length ? lines.tags[0]/hertz[0] : null)
} else if (frequency.length) {
  const {start, end} = plot.x_range, near = 0.008*(end - start)
  const was = lines.tags.length ? lines.tags[0]/hertz[0] : null
  let best = -1
  frequency.forEach((f, i) => {
    if (Math.abs(f - cb_obj.x) <= near && (best < 0 || amplitude[i] > amplitude[best])) best = i
  })
  const at = best < 0 ? cb_obj.x : frequency[best]
  draw(was !== null && Math.abs(was - cb_obj.x) <= near ? null : at)
}
