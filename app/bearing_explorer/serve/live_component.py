"""A component that takes and sends many messages, at a tenth of the cost of Panel's own ways."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bokeh.document import Document

from bearing_explorer.serve.fast import DirectComponent
from bearing_explorer.serve.live import on_loop


class LiveComponent(DirectComponent):
    """A component that takes and sends many messages.

    Panel counts a session as busy while it handles a message, and sets a property of all of its
    models then; and it compares, links and walks models at each change of a parameter. Here
    messages are simply handed on, and `put` writes to the browser's models.
    """

    def put(self, **values: Any) -> None:
        """Give parameters new values. They show in the browser; before it is there they wait.

        Call it on the event loop of the session, inside `one_message`.
        """
        models = self.models_shown()
        if not models:
            self.param.update(**values)
        for model in models:
            changed = {name: v for name, v in values.items() if getattr(model.data, name) != v}
            if changed:
                model.data.update(**changed)

    def send(self, message: Any) -> None:
        """Send something to the component's script."""
        self._send_msg(message)

    def take(self, doc: Document, event: Any, callbacks: list[Callable[[Any], None]]) -> None:
        """Hand a message of the browser on to what `on_msg` was given."""

        def hand_on() -> None:
            for callback in callbacks:
                callback(event)

        on_loop(doc, hand_on)
