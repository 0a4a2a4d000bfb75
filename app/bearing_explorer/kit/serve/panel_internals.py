"""Private names of Panel, which make the page quicker; no other file uses any.

* `_models`, `_msg__callbacks`, `_process_bokeh_event`, and param's `no_instance_params`: a message
  of a component takes a tenth of the time (`LiveComponent`). Without them Panel handles it.
* `_linked_properties`, `_bundle_path`: Panel skips a search for links and bundles that do not
  exist. Without them it searches.
* `_render_items`: the page is written once (`PageTemplate`). Without it the page is written once
  per part.

Any release may remove them, so each use checks that they exist. Panel documents `_esm`,
`_stylesheets` and `_send_msg`, which `send` calls. ``BEARING_EXPLORER_PLAIN=1`` avoids the others
(`bokeh_internals`).
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
    """A component that receives and sends many messages.

    While Panel handles a message it marks the session as busy, by a property of all models. At each
    change of a parameter it also compares, links and walks models. This class hands messages on
    directly, and `put` writes to the browser's models.
    """

    margin = param.Parameter(default=0)
    sizing_mode = param.Selector(default="stretch_width")

    if not PLAIN:
        #: scripts answer with messages: no property is synchronised back
        _linked_properties = ()
        #: Panel looks for a bundle whenever a component is shown; this one has none
        _bundle_path = None

    def __init__(self, **params: Any) -> None:
        if not PLAIN:
            no_instance_params(type(self))
        super().__init__(**params)

    def put(self, **values: Any) -> None:
        """Set parameters, and show them in the browser as soon as it has the component.

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
        """Send a message to the component's script."""
        self._send_msg(message)

    def _process_bokeh_event(self, doc: Document, event: Any) -> None:
        """Pass a message of the browser to the callbacks of `on_msg`."""
        callbacks = None if PLAIN else getattr(self, "_msg__callbacks", None)
        if not isinstance(event, DataEvent) or callbacks is None:
            super()._process_bokeh_event(doc, event)
            return

        def hand_on() -> None:
            for callback in list(callbacks):
                callback(event)

        run_on_loop(doc, hand_on)


class PageTemplate(pn.Template):
    """Panel's template, with its models counted once per page instead of once per part.

    Otherwise Bokeh walks all models of the document for each added root, and Panel writes the whole
    template as text for each named part.
    """

    def server_doc(self, doc: Document | None = None, *arguments: Any, **named: Any) -> Document:
        """Return the document of a session."""
        if doc is None:
            return super().server_doc(doc, *arguments, **named)
        # Panel sets this when it writes the page. The session of the websocket may be in another
        # process; its style sheets would then come from Panel's public site, or not at all.
        doc.template_variables["dist_url"] = LOCAL_DIST
        with doc.models.freeze():
            return super().server_doc(doc, *arguments, **named)

    def __repr__(self) -> str:
        parts = None if PLAIN else getattr(self, "_render_items", None)
        return super().__repr__() if parts is None else f"{type(self).__name__}({', '.join(parts)})"
