"""What a diagnosis looks like: the bearing with the part marked and words, and the evidence."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from bearing_explorer.assets import asset_text, scripts


class PartPanel(JSComponent):
    """The bearing with the damaged part marked, the answer in words, and on what it rests."""

    #: {"mood": "busy" | "fault" | "healthy" | "unknown", "part", "color", "headline",
    #: "probability", "plain", "pass_on", "facts": [[name, value]], "bearing": {...}}
    state = param.Dict(default={})

    _esm = scripts("element.js", "figure_export.js", "part.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("part.css")]

    def __init__(self, **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)


class EvidenceTable(JSComponent):
    """What speaks for each part. `asked` gets {"zoom": [part, harmonic]}: judge it."""

    #: of `part_words.evidence_rows`
    rows = param.List(default=[])
    #: the line that is zoomed to: "inner race 2"
    looked = param.String()

    _esm = scripts("element.js", "evidence.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("evidence.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))
