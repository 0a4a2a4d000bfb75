// Changes of the scene, from any panel. Each carries a number (`window.__asked`), by which a panel
// knows when it is drawn. The newest position of a slider that waits to be sent (`window.__waiting`:
// functions that send it) goes first: a choice or an undo never overtakes it.
function ask(model, message) {
  for (const send_now of window.__waiting ?? []) send_now()
  window.__asked = (window.__asked || 0) + 1
  model.send_msg({ mark: window.__asked, ...message })
}
function keep_waiting(send_now) {
  (window.__waiting ??= new Set()).add(send_now)
}
