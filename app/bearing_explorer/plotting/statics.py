"""Load distribution, stiffness and natural frequencies over the cage angle."""

from __future__ import annotations

import math
from collections.abc import Sequence

import holoviews as hv
import numpy as np

from bearing_explorer.plots import style
from bearing_explorer.plotting.style import Axes, curve_options, dimension
from bearing_explorer.results.load_curve import load_curve
from bearingcore import STIFFNESS_TERMS, Equilibrium, Modes, frequency_bands
from bearingcore.common import checks
from bearingcore.statics.equilibrium import TERM_SYMBOLS, TERM_UNITS
from bearingcore.sweep.outputs import mode_symbol

_CAGE_ANGLE = dimension("cage_angle_deg", style.CAGE_ANGLE)
_COLORS = (*style.DIRECTION_COLORS, "#E69F00", "#F0C419", style.INK)


def load_distribution(
    state: Equilibrium, *, healthy: Equilibrium | None = None, cage_angle: float | None = None
) -> hv.Overlay:
    """What a ball carries at each place around the bearing (Fig. 3), and the balls where they are.

    Parameters
    ----------
    state
        over a ball spacing or more, or the curve has gaps.
    healthy
        the same without the defect, drawn grey.
    cage_angle
        [rad] at which the balls are drawn: the nearest that `state` has; None takes the first.
    """
    angle = dimension("angular_position_deg", style.BALL_ANGLE, range=(0.0, 360.0))
    load = dimension("ball_load", style.BALL_LOAD)
    axes = Axes(style.BALL_ANGLE, style.BALL_LOAD)
    drawn: list[hv.Element] = []
    for given, label, color in (
        (healthy, "without the defect", style.HEALTHY),
        (state, "with the defect", style.DEFECTIVE),
    ):
        if given is not None:
            places, loads = load_curve(given)
            curve = hv.Curve((np.degrees(places), loads), angle, load, label=label)
            drawn.append(curve.opts(color=color, line_width=2))
    at = 0 if cage_angle is None else int(np.abs(state.cage_angles - cage_angle).argmin())
    turned = math.degrees(state.cage_angles[at])
    balls = hv.Points(
        (np.degrees(state.ball_angle[at]), state.ball_load[at]),
        [angle, load],
        label=f"balls at a cage angle of {turned:.3g}°",
    )
    drawn.append(balls.opts(color=style.INK, size=7, tools=["hover"]))
    return hv.Overlay(drawn).opts(
        **curve_options(axes, xlim=(0, 360), xticks=list(range(0, 361, 60)), legend_position="top")
    )


_DASHES = ("solid", "dashed", "dotted", "dotdash", "dashdot") * 2
"""Of several grey curves, so that each can be told from the next."""


def stiffness(
    state: Equilibrium,
    terms: Sequence[str] = ("k_xx", "k_yy"),
    *,
    healthy: Equilibrium | None = None,
) -> hv.Overlay:
    """Terms of the stiffness of the bearing over the cage angle (Eq. 17), all of one unit.

    Parameters
    ----------
    terms
        of `bearingcore.STIFFNESS_TERMS`.
    healthy
        the same without the defect, drawn grey.
    """
    unit = _unit_of(terms)
    quantity = style.AxisQuantity("Stiffness", "k", unit, prefixed=True)
    value = dimension("stiffness", quantity)
    axes = Axes(style.CAGE_ANGLE, quantity)
    drawn = [
        hv.Curve((np.degrees(given.cage_angles), given.term(term)), _CAGE_ANGLE, value, label=label)
        .opts(color=color, line_width=width, line_dash=dash)
        for given, width in ((healthy, 1.5), (state, 2.0))
        if given is not None
        for term, own, grey_dash in zip(terms, _COLORS, _DASHES, strict=False)
        for label, color, dash in (
            [(TERM_SYMBOLS[term], own, "solid")] if given is state
            else [(f"{TERM_SYMBOLS[term]} without the defect", style.HEALTHY, grey_dash)]
        )
    ]  # fmt: skip
    return hv.Overlay(drawn).opts(**curve_options(axes, legend_position="right"))


def _unit_of(terms: Sequence[str]) -> str:
    for term in terms:
        if term not in STIFFNESS_TERMS:
            raise checks.refuse("stiffness term", term, ", ".join(STIFFNESS_TERMS))
    units = {TERM_UNITS[term] for term in terms}
    if len(units) != 1 or len(terms) > len(_COLORS):
        raise checks.refuse(
            "terms", tuple(terms), f"1 to {len(_COLORS)} terms of one unit; here: {sorted(units)}"
        )
    return units.pop()


def modes(found: Modes, *, healthy: Modes | None = None) -> hv.Overlay:
    """Natural frequencies over the cage angle, and the band in which each moves (Fig. 8).

    Parameters
    ----------
    healthy
        the same without the defect, drawn grey.
    """
    quantity = style.AxisQuantity("Natural frequency", "f", "Hz")
    value = dimension("natural_frequency", quantity)
    axes = Axes(style.CAGE_ANGLE, quantity)
    drawn: list[hv.Element] = []
    angles = np.degrees(found.cage_angles)
    for label, (low, high) in frequency_bands(found.scene, found.cage_angles).items():
        if math.isfinite(low):
            band = hv.Area(
                (angles[[0, -1]], [low, low], [high, high]),
                _CAGE_ANGLE,
                [value, hv.Dimension("greatest", unit="Hz")],
            )
            drawn.append(band.opts(color=_mode_color(label), alpha=0.10, line_alpha=0.0))
    if healthy is not None:
        drawn += [
            hv.Curve(
                (np.degrees(healthy.cage_angles), healthy.frequency[:, i]), _CAGE_ANGLE, value
            ).opts(color=style.HEALTHY, line_width=1.5)
            for i in range(len(healthy.label))
        ]
    for i, label in enumerate(found.label):
        curve = hv.Curve(
            (angles, found.frequency[:, i]), _CAGE_ANGLE, value, label=mode_symbol(label)
        )
        dash = "solid" if label.endswith("1") else "dashed"
        drawn.append(curve.opts(color=_mode_color(label), line_width=2, line_dash=dash))
    return hv.Overlay(drawn).opts(**curve_options(axes, legend_position="right"))


def _mode_color(label: str) -> str:
    return style.DIRECTION_COLORS[style.DIRECTIONS.index(label.rstrip("0123456789"))]
