"""Private names of Panel, and what is quicker by them; no other file uses any.

* `_models`, `_msg__callbacks`, `_process_bokeh_event`, and param's `no_instance_params`: a message
  of a component takes a tenth of the time (`LiveComponent`). Without: Panel's own ways.
* `_linked_properties`, `_bundle_path`: nothing is looked for that is not there. Without: it is.
* `_render_items`: the page is not written for each of its parts (`PageTemplate`). Without: it is.

They may go with any release, and are looked for as they are used. Panel's documents name `_esm`,
`_stylesheets` and `_send_msg`, which `send` calls. ``BEARING_EXPLORER_PLAIN=1`` does without the
others (`bokeh_internals`).
"""

from __future__ import annotations

from typing import Any

import panel as pn
import param
from bokeh.document import Document
from panel.custom import JSComponent
from panel.io.resources import LOCAL_DIST
from panel.models.esm import DataEvent
from param.parameterized import no_instance_params

from bearing_explorer.kit.serve.bokeh_internals import PLAIN
from bearing_explorer.kit.serve.live import run_on_loop


class LiveComponent(JSComponent):
    """A component that takes and sends many messages.

    Panel counts a session as busy while it handles a message, and sets a property of all of its
    models then; and it compares, links and walks models at each change of a parameter. Here
    messages are simply handed on, and `put` writes to the browser's models.
    """

    margin = param.Parameter(default=0)
    sizing_mode = param.Selector(default="stretch_width")

    if not PLAIN:
        #: scripts answer with messages: nothing comes back by a property
        _linked_properties = ()
        #: no script lies in a bundle, which Panel would look for whenever one is shown
        _bundle_path = None

    def __init__(self, **params: Any) -> None:
        if not PLAIN:
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

        run_on_loop(doc, hand_on)


class PageTemplate(pn.Template):
    """Panel's template with its models counted once a page instead of once a part.

    Each root that is added makes Bokeh walk all models of the document, and each part that is
    named makes Panel write out the whole template as text.
    """

    def server_doc(self, doc: Document | None = None, *arguments: Any, **named: Any) -> Document:
        """The document of a session."""
        if doc is None:
            return super().server_doc(doc, *arguments, **named)
        # Panel sets this when it writes the page, which may be in another process than the session
        # of its websocket: style sheets would come from Panel's public site then, or not at all.
        doc.template_variables["dist_url"] = LOCAL_DIST
        with doc.models.freeze():
            return super().server_doc(doc, *arguments, **named)

    def __repr__(self) -> str:
        parts = None if PLAIN else getattr(self, "_render_items", None)
        return super().__repr__() if parts is None else f"{type(self).__name__}({', '.join(parts)})"
