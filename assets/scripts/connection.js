// Says on the page that its connection to the server is over, and why: what the server gave as its
// reason, or that it was lost. Runs before Bokeh opens the connection, which itself says it to the
// console alone.
{
  const WAIT = 1013         // the server's code: come back later

  let leaving = false
  addEventListener("pagehide", () => { leaving = true })
  addEventListener("pageshow", () => { leaving = false })

  const say = (words) => {
    if (!document.body) return addEventListener("DOMContentLoaded", () => say(words), { once: true })
    document.getElementById("connection-over")?.remove()
    const line = document.createElement("p")
    line.id = "connection-over"
    line.setAttribute("role", "alert")
    document.body.append(line)
    line.textContent = words
  }

  const over = (event) => {
    if (leaving || event.code === 1000) return
    const why = event.reason || "The connection to the server is lost."
    const when = event.code === WAIT ? "Reload the page in a minute." : "Reload the page to go on."
    say(`${why} ${when}`)
  }

  window.WebSocket = class extends window.WebSocket {
    constructor(...given) {
      super(...given)
      this.addEventListener("close", over)
    }
  }
}
