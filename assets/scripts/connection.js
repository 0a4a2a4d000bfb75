// Says on the page that its connection to the server is over, and why: what the server gave as its
// reason, or that it was lost; and that the server is silent while something is to be drawn. Runs
// before Bokeh opens the connection, which itself says it to the console alone.
{
  const WAIT = 1013         // the server's code: come back later
  const SILENT = 4000       // ms without a message, while a change waits to be drawn
  const LOOKS = 1000        // ms from one look to the next

  let leaving = false, heard = 0
  addEventListener("pagehide", () => { leaving = true })
  addEventListener("pageshow", () => { leaving = false })

  const say = (words, role) => {
    if (!document.body)
      return addEventListener("DOMContentLoaded", () => say(words, role), { once: true })
    document.getElementById("connection-note")?.remove()
    if (!words) return
    const line = document.createElement("p")
    line.id = "connection-note"
    line.setAttribute("role", role)
    document.body.append(line)
    line.textContent = words
  }

  let silent = false
  const look = setInterval(() => {
    const now = performance.now()
    const compiling = document.documentElement.hasAttribute("data-compiling")  // its bar says so
    if (compiling || !(window.__asked > (window.__mark ?? 0))) heard = now
    if (silent === now - heard > SILENT) return
    silent = !silent
    say(silent && "The server does not answer. What you change is drawn as soon as it does.", "status")
  }, LOOKS)

  const over = (event) => {
    clearInterval(look)
    if (leaving || event.code === 1000) return
    const why = event.reason || "The connection to the server is lost."
    const when = event.code === WAIT ? "Reload the page in a minute." : "Reload the page to go on."
    say(`${why} ${when}`, "alert")
  }

  window.WebSocket = class extends window.WebSocket {
    constructor(...given) {
      super(...given)
      this.addEventListener("close", over)
      this.addEventListener("message", () => { heard = performance.now() })
    }
  }
}
