"""Parts of the session that views of a signal are attached to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.kit.views.base import SessionParts
from bearingcore import Scene


@dataclass(frozen=True)
class SignalParts(SessionParts):
    """Parts of the session that views of a signal need besides.

    Parameters
    ----------
    measurement
        the measured signal.
    scene_now
        gives the scene with which it is compared.
    """

    measurement: Measurement
    scene_now: Callable[[], Scene]
