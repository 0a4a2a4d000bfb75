// What the server says next waits until the views of what it said last stand.
//
// BokehJS builds a view in steps that wait for each other, as the script of a component is loaded as
// a module, and a view hears of changes only once it stands. What came meanwhile was lost: the
// children of a layout that came in a second message, the numbers of a figure. And a layout two of
// whose changes came close to each other built a child twice. So frames of the connection queue here
// while views are built. Without the private name of BokehJS they pass as they come.
{
  const LONGEST = 10000  // ms that a view is waited for: one that fails must not silence the page

  const frames = []
  let building = 0, hearing = false
  // In a task of its own: all that follows at once upon the last view is done by then. Timers would
  // come once a second on a page that is not looked at.
  const soon = (act) => {
    const { port1, port2 } = new MessageChannel()
    port1.onmessage = () => { port1.close(); act() }
    port2.postMessage(null)
  }

  // Each in a task of its own, as they came: a callback of BokehJS runs a little later than the
  // change that it belongs to, and would find the numbers of the next one.
  const hear = () => {
    hearing = false
    if (building > 0 || frames.length === 0) return
    try { frames.shift()() } catch (error) { reportError(error) }
    hear_next()
  }
  const hear_next = () => {
    if (hearing || frames.length === 0) return
    hearing = true
    soon(hear)
  }
  const begin = () => {
    building += 1
    let over = false
    const end = () => {
      if (over) return
      over = true
      clearTimeout(given_up)
      building -= 1
      if (building === 0) hear_next()
    }
    const given_up = setTimeout(end, LONGEST)
    return () => soon(end)
  }

  window.WebSocket = class extends window.WebSocket {
    get onmessage() { return super.onmessage }
    set onmessage(act) {
      super.onmessage = act && ((event) => {
        frames.push(() => act.call(this, event))
        if (frames.length === 1 && !hearing) hear()
      })
    }
  }

  let layout = globalThis.Bokeh?.Models?.get("Column")?.prototype.default_view?.prototype
  while (layout && !Object.hasOwn(layout, "build_child_views")) layout = Object.getPrototypeOf(layout)
  if (layout) {
    const build = layout.build_child_views
    layout.build_child_views = async function (...rest) {
      const end = begin()
      try {
        return await build.apply(this, rest)
      } finally {
        end()
      }
    }
  }
  window.in_order = { missing: layout ? [] : ["build_child_views"], get waiting() { return frames.length } }
}
