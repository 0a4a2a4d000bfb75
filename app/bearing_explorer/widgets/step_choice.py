"""The steps of motions: the program's own choice, or set by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import param

from bearing_explorer.assets import asset_path, asset_text
from bearing_explorer.serve.live_component import LiveComponent


class StepChoice(LiveComponent):
    """Says which steps motions are marched with, and lets them be chosen or reset.

    `asked` gets {"use": text} of the browser, from strangers too: judge it.
    """

    options = param.List(default=[])  # [[step rate as text, words], ...]
    chosen = param.String()  # step rate as text, empty for the program's own
    words = param.String()

    _esm = asset_path("step_choice.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("field.css"), asset_text("job.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))
