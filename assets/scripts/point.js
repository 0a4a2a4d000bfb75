// The mouse moves over a figure, or leaves it: which element of a source is near? See pointed.js.
const NEAR = 16  // [px]
const { frame } = Bokeh.index.find_one_by_id(plot.id)
const pixels = (range, size) => size / (range.end - range.start)
const wide = pixels(plot.x_range, frame.bbox.width), high = pixels(plot.y_range, frame.bbox.height)
const { data } = source, far = (i) => Math.hypot(wide * (data[x][i] - cb_obj.x), y ? high * (data[y][i] - cb_obj.y) : 0)
const near = cb_obj.event_name === "mouseleave" ? [] : [...data.element.keys()].filter((i) => far(i) < NEAR)
const element = near.length ? Math.abs(data.element[near.reduce((a, b) => far(b) < far(a) ? b : a)]) : 0
if (window.__pointed !== element) {
  window.__pointed = element
  window.dispatchEvent(new CustomEvent("explorer-pointed", { detail: element ? [element] : [] }))
}
