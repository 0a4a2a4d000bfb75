"""The bar above the controls: undo and redo, links, kept scenes, files."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from bearing_explorer.explorer.messages import LinksChange
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import take


class ShareBar(JSComponent):
    """Buttons for undo, redo and reset, and menus to share, keep and download.

    `on_message` is called with each message as a dictionary with fields of `LinksChange`.
    """

    #: state by `Bookmarks.state`
    state = param.Dict(default={})

    _esm = scripts(
        "element.js", "figure_export.js", "report.js", "asking.js", "share.html", "share.js"
    )
    _stylesheets: ClassVar[list[str]] = [asset_text("menu.css"), asset_text("share.css")]

    def __init__(self, on_message: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: take(on_message, LinksChange, event.data))

    def answer(self, **news: Any) -> None:
        """Send the browser a `file` to save, a `kept` scene or a `report`."""
        self._send_msg(news)
