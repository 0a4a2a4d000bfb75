"""The strip with warnings where a scene leaves the limits of the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import param

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.serve.panel_internals import LiveComponent


class LimitsStrip(LiveComponent):
    """Warnings for limits that are exceeded, and a table of all limits on demand."""

    #: rows of `rows_of`
    rows = param.List(default=[])
    #: all limits in a line
    summary = param.String()

    _esm = scripts("element.js", "limits.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("limits.css"),
    ]


def judged(status: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the status line, as a warning if all is computed but a limit of `rows` is exceeded."""
    crossed = any(row["state"] == "crossed" for row in rows)
    if not crossed or status["mood"] != "good":
        return dict(status)
    words = status["words"].removesuffix(" without problems")
    return {**status, "mood": "warn", "words": f"{words}, limits exceeded"}
