"""A picture of the views on screen, computed off the event loop; failures become sentences."""

from __future__ import annotations

import logging
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.sentences import words_of
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.views.content import Content, Warnings

log = logging.getLogger(__name__)

BROKEN = "This could not be computed; what is shown belongs to an earlier scene."
_DRAWN_LATER = "This is drawn by itself as soon as that is done."


@dataclass(frozen=True)
class Drawing:
    """Data and sentence of a view; `data` is None where it cannot be drawn."""

    view: View
    data: tuple[Sources, Ranges] | None
    sentence: str


@dataclass(frozen=True)
class Picture:
    """Drawings of some views, status of the computation, its duration and processor time [s]."""

    content: Content
    drawings: list[Drawing]
    status: dict[str, Any]
    warnings: Warnings | None
    seconds: float
    work: float


def picture_of(
    content: Content,
    views: Sequence[View],
    warnings: bool = False,
    on_screen: Sequence[View] = (),
) -> Picture:
    """Draw `views`, and compute warnings if `warnings` is True.

    `on_screen`: the views to which the status applies, if they are more than those drawn.
    """
    started, worked = time.perf_counter(), time.thread_time()  # waiting does not count
    shown = frozenset[str]().union(*(view.needs for view in on_screen or views))
    content.prefetch(shown)
    drawings = [drawing_of(content, view) for view in views]
    work = time.thread_time() - worked
    checked = None
    try:
        checked = content.warnings if warnings else None
        status = content.status(work, shown)
        if status["mood"] == "good" and any(drawing.data is None for drawing in drawings):
            status |= {"mood": "busy", "words": "Not all can be shown"}
    except compiling.StillCompiling as wait:
        status = {"mood": "busy", "words": f"Not ready: {wait}", "details": []}
    return Picture(content, drawings, status, checked, time.perf_counter() - started, work)


def drawing_of(content: Content, view: View) -> Drawing:
    """Draw a view; without a drawing, its sentence gives the reason."""
    try:
        return Drawing(view, view.all_data(content), view.sentence(content))
    except compiling.StillCompiling as wait:
        words = str(wait)
        return Drawing(view, None, f"{words[0].upper()}{words[1:]}. {_DRAWN_LATER}")
    except ValueError as error:
        return Drawing(view, None, f"Not shown for this scene: {words_of(error)}.")
    except Exception:
        log.exception("the view %s failed", view.name)
        return Drawing(view, None, BROKEN)
