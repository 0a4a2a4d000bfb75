"""What a signal says about the size of a defect."""

from __future__ import annotations

import math
import textwrap

import holoviews as hv

from bearing_explorer.plots import style
from bearing_explorer.plotting.style import Axes, curve_options, dimension
from bearingcore.diagnosis.size.sizing import Sizing

_EXTENT = style.AxisQuantity("Extent", "Δφf", "°")
_PROBABILITY = style.AxisQuantity("Probability", "P", "")


def sizing(found: Sizing, *, true_extent: float | None = None) -> hv.Overlay:
    """Probabilities of the extents that the signal allows; its title says what follows.

    Parameters
    ----------
    true_extent
        [rad], drawn as an upright line where it is known.
    """
    places = [math.degrees(candidate.extent) for candidate in found.candidates]
    sure = [candidate.probability for candidate in found.candidates]
    kdim, vdim = dimension("extent_deg", _EXTENT), dimension("probability", _PROBABILITY)
    axes = Axes(_EXTENT, _PROBABILITY)
    drawn: list[hv.Element] = [
        hv.Spikes((places, sure), kdim, vdim).opts(color=style.DEFECTIVE, line_width=6),
        hv.Points((places, sure), [kdim, vdim]).opts(color=style.DEFECTIVE, size=9),
    ]
    if true_extent is not None:
        line = hv.VLine(math.degrees(true_extent))
        drawn.append(line.opts(color=style.DEFECT, line_width=2, line_dash="dashed"))
    far = max([*places, math.degrees(true_extent or 0.0)])
    return hv.Overlay(drawn).opts(
        **curve_options(
            axes,
            title=textwrap.fill(found.status, 84),
            xlim=(0.0, 1.1 * far),
            ylim=(0.0, 1.1),
        )
    )
