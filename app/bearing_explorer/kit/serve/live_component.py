"""A component that takes and sends many messages, at a tenth of the cost of Panel's own ways."""

from __future__ import annotations

from typing import Any

import param
from bokeh.document import Document
from panel.custom import JSComponent
from panel.models.esm import DataEvent
from param.parameterized import no_instance_params

from bearing_explorer.kit.serve.fast import PLAIN
from bearing_explorer.kit.serve.live import on_loop


class LiveComponent(JSComponent):
    """A component that takes and sends many messages.

    Panel counts a session as busy while it handles a message, and sets a property of all of its
    models then; and it compares, links and walks models at each change of a parameter. Here
    messages are simply handed on, and `put` writes to the browser's models.
    """

    margin = param.Parameter(default=0)
    sizing_mode = param.Selector(default="stretch_width")

    #: scripts answer with messages: nothing comes back by a property
    _linked_properties = ()
    #: no script lies in a bundle, which Panel would look for whenever one is shown
    _bundle_path = None

    def __init__(self, **params: Any) -> None:
        no_instance_params(type(self))
        super().__init__(**params)

    def put(self, **values: Any) -> None:
        """Give parameters new values. They show in the browser; before it is there they wait.

        Call it on the event loop of the session, inside `one_message`.
        """
        shown = {} if PLAIN else getattr(self, "_models", {})
        if not shown:
            self.param.update(**values)
        for model in {id(model): model for model, _ in shown.values()}.values():
            changed = {name: v for name, v in values.items() if getattr(model.data, name) != v}
            if changed:
                model.data.update(**changed)

    def send(self, message: Any) -> None:
        """Send something to the component's script."""
        self._send_msg(message)

    def _process_bokeh_event(self, doc: Document, event: Any) -> None:
        """Hand a message of the browser on to the callbacks of `on_msg`."""
        callbacks = None if PLAIN else getattr(self, "_msg__callbacks", None)
        if not isinstance(event, DataEvent) or callbacks is None:
            super()._process_bokeh_event(doc, event)
            return

        def hand_on() -> None:
            for callback in list(callbacks):
                callback(event)

        on_loop(doc, hand_on)
