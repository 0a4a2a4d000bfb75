"""The status line, in words and in colour, and the tabs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import param

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import TabChange, take
from bearing_explorer.kit.serve.panel_internals import LiveComponent


class StatusLine(LiveComponent):
    """Convergence, residual, degrees of freedom and computing time of a picture."""

    #: {"mood": "good" | "warn" | "bad" | "busy", "words": str, "details": [str, ...]}
    #: and, for a picture, "tab": str and "resting": bool
    line = param.Dict(default={"mood": "busy", "words": "Computing", "details": []})
    #: compilation: {"done": int, "of": int, "words": str, "still": bool}; empty once all is ready
    progress = param.Dict(default={})
    #: True if a button opens the details in a list above the line
    folded = param.Boolean(default=False)

    _esm = scripts("element.js", "status.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("status.css"),
    ]


class Tabs(LiveComponent):
    """The tabs of the page."""

    names = param.List(default=[])  # [[name, title, title of the tab], ...]
    active = param.String()

    _esm = scripts("element.js", "tabs.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("tabs.css")]

    def __init__(self, open_tab: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, **params)
        self.on_msg(lambda event: take(open_tab, TabChange, event.data))
