// The simulated motion, slowly: shows an instant of the stretch that the server has sent in the figures
// of this view. See app/bearing_explorer/explorer/views/slow_passage.py.

const SLOWNESS = [1, 10, 30, 100, 300, 1000]  // times slower than the machine
const LONGEST = 100  // ms that a picture stands for at most: a page that was not looked at does not jump

export function render({ model }) {
  const source_of = (name) => Bokeh.documents[0].get_model_by_name(`slow_${name}`)
  const data_of = (name) => source_of(name)?.data
  const write = (name, columns) => { source_of(name).data = { ...data_of(name), ...columns } }
  let frame = null, shown = null, playing = false, last = 0  // frame: its number, with a fraction
  const length = () => {
    const { time } = data_of("frames")
    return time[time.length - 1] - time[0]
  }

  const play = button("Play", () => set_playing(!playing), { class: "play" })
  const speed = element("select", {}, ...SLOWNESS.map((slow) =>
    element("option", { value: String(slow) }, slow === 1 ? "full speed" : `1/${slow}`)))
  speed.value = "100"
  const place = element("input", { type: "range", min: "0", step: "1", class: "place", "aria-label": "Instant" })
  const now = element("output")
  const root = element("div", { class: "slow", role: "group", "aria-label": "Slow motion" }, play,
    element("label", {}, "Speed", speed), place, now)

  // An instant: numbers of frames are taken between those of its neighbours.
  const show = (wanted) => {
    const { time, turned, shaft } = data_of("frames"), { angle } = data_of("start")
    const { radius, load } = data_of("path"), { bar_start: [start], bar_length: [per_load] } = data_of("scale")
    frame = Math.max(0, Math.min(wanted, time.length - 1))
    const first = Math.min(Math.floor(frame), time.length - 2), share = frame - first, n = angle.length
    const at = (values, j = 0, width = 1) =>
      (1 - share) * values[first * width + j] + share * values[(first + 1) * width + j]
    const polar = (radii, turn) => ({ x: radii.map((r, j) => r * Math.cos(angle[j] + turn)),
                                      y: radii.map((r, j) => r * Math.sin(angle[j] + turn)) })
    const turn = at(turned), loads = load.slice(0, n).map((_, j) => at(load, j, n))
    const balls = polar(radius.slice(0, n).map((_, j) => at(radius, j, n)), turn)
    write("balls", { ...balls, load: loads })
    if (data_of("roller_ends").x.length) write("roller_ends", balls)
    const ends = loads.map((one) => one > 0 ? start + per_load * one : NaN), most = Math.max(...loads)
    const from = polar(loads.map(() => start), turn), to = polar(ends, turn)
    // their numbers as in views/bearing.py
    const { number_right: [wide], number_up: [high] } = data_of("scale")
    const sin = loads.map((_, j) => Math.sin(angle[j] + turn))
    write("bars", { x0: from.x, y0: from.y, x1: to.x, y1: to.y, x: from.x, y: to.y,
                    right: loads.map((_, j) => wide * Math.cos(angle[j] + turn)),
                    down: sin.map((one) => one > -1e-9 ? -high : high),
                    load: loads, most: loads.map((one) => Number(one === most)) })
    for (const name of ["rings", "defect"]) {
      const { x, y, turns } = data_of(`base_${name}`), by = at(shaft)
      if (!turns.some((one) => one)) continue  // it is at rest
      const cos = turns.map((one) => Math.cos(one * by)), sin = turns.map((one) => Math.sin(one * by))
      write(name, { x: x.map((one, i) => cos[i] * one - sin[i] * y[i]),
                    y: y.map((one, i) => sin[i] * x[i] + cos[i] * one) })
    }
    write("cursor", { now: Float32Array.of(at(time)) })
    place.max = String(time.length - 1)
    place.value = String(Math.round(frame))
    now.textContent = `${(1000 * at(time)).toFixed(2)} ms`.replace("-", "\u2212")
    place.setAttribute("aria-valuetext", now.textContent)
  }

  const step = (passed) => {
    if (!playing || !root.isConnected) return
    const frames = data_of("frames").time.length - 1
    const by = Math.min(passed - last, LONGEST) / 1000 / Number(speed.value) / length() * frames
    last = passed
    show((frame + by) % frames)
    requestAnimationFrame(step)
  }
  const set_playing = (wanted) => {
    if (wanted && !(length() > 0)) return
    playing = wanted
    play.textContent = playing ? "Pause" : "Play"
    last = performance.now()
    if (playing) requestAnimationFrame(step)
  }
  place.addEventListener("input", () => { set_playing(false); show(Number(place.value)) })
  on_event("tab", root, () => { if (playing) set_playing(false) })
  // A new motion: the same share of it, from the first on the entry of a ball.
  const take = () => {
    const frames = root.isConnected && data_of("frames")
    if (!frames?.time.length || frames === shown) return
    shown = frames
    show(frame ?? Math.max(frames.time.findIndex((one) => one >= -1e-9), 0))
  }
  on_event("drawn", root, take)
  requestAnimationFrame(take)
  return root
}
