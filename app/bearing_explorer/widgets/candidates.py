"""Candidates for the extent of a defect, as a list of bars that can be looked at and taken."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.measurement.session import Sized
from bearing_explorer.plots import style
from bearingcore import Candidate, Scene
from bearingcore.common.numbers import probability


class CandidateList(JSComponent):
    """Candidates as bars of probability. `asked` gets {"look": index}: judge it."""

    rows = param.List(default=[])
    looked = param.Integer(default=0)

    _esm = scripts("element.js", "sizing.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("sizing.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))


def rows(sized: Sized) -> list[dict[str, Any]]:
    """The candidates as the browser lists them."""
    candidates = sized.sizing.candidates
    spacing = sized.scene.bearing.ball_spacing
    truth = sized.measured.true_extent
    nearest = None
    if truth is not None:
        nearest = min(range(len(candidates)), key=lambda i: abs(candidates[i].extent - truth))
    return [
        {
            "extent": in_degrees(candidate.extent),
            "length": along_race(candidate.extent, sized.scene),
            "extent_deg": round(math.degrees(candidate.extent), 2),
            "made_of": made_of(candidate, spacing),
            "probability": candidate.probability,
            "percent": probability(candidate.probability),
            "explains": "explains "
            f"{100.0 * max(1.0 - float(candidate.waveform_misfit.mean()), 0.0):.0f} % of the mean "
            "ball pass",
            "fitted": fitted(candidate),
            "truth": in_degrees(truth) if index == nearest and truth is not None else "",
        }
        for index, candidate in enumerate(candidates)
    ]


def made_of(candidate: Candidate, spacing: float) -> str:
    """How many whole ball spacings [rad] an extent holds, and the rest."""
    rest = candidate.extent - candidate.turns * spacing
    return f"{candidate.turns} × {in_degrees(spacing)} + {in_degrees(rest)}"


def fitted(candidate: Candidate) -> str:
    """What a candidate had to be made of to fit."""
    names = {"stiffness": "support", "load_deflection_factor": "contacts"}
    parts = [
        f"{names.get(name, name)} ×{factor:.2f}"
        for name, factor in candidate.factors.items()
        if abs(factor - 1.0) >= 0.005
    ]
    return ", ".join(parts) if parts else "the scene's numbers as they are"


def along_race(extent: float, scene: Scene) -> str:
    """How long an extent [rad] is on the outer race, in mm."""
    return style.with_prefix(extent * scene.bearing.outer_raceway_radius, "m")


def in_degrees(angle: float) -> str:
    """An extent [rad] in degrees; unlike a place it may be more than a turn."""
    return f"{math.degrees(angle):.1f}°"
