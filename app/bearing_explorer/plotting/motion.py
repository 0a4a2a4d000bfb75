"""What moves: acceleration in time, spectra, and the orbit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import holoviews as hv
import numpy as np
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plotting.style import Axes, curve_options, dimension
from bearingcore import DOF_NAMES, Motion, Orbit, Spectrum
from bearingcore.common import checks

_TIME = style.AxisQuantity("Time", "t", "s", prefixed=True)
_FREQUENCY = style.AxisQuantity("Frequency", "f", "Hz", prefixed=True)


def motion(found: Motion, dof: str = "y", *, last: float | None = None) -> hv.Curve:
    """Acceleration of the housing along (or about) one direction.

    Parameters
    ----------
    dof
        of `found.dofs`.
    last
        [s] of the end of the motion that are drawn; None draws all.
    """
    if dof not in found.dofs:
        raise checks.refuse("dof", dof, ", ".join(found.dofs))
    start = 0 if last is None else max(found.time.size - round(last * found.sample_rate), 0)
    way, unit = ("about", "rad/s²") if dof.startswith("r") else ("along", "m/s²")
    quantity = style.AxisQuantity(f"Housing acceleration {way} {dof[-1]}", "a", unit, prefixed=True)
    value = found.outer_acceleration[start:, found.dofs.index(dof)]
    curve = hv.Curve(
        (found.time[start:], value),
        dimension("time", _TIME),
        dimension(f"acceleration_{dof}", quantity),
    )
    color = style.DIRECTION_COLORS[DOF_NAMES.index(dof)]
    return curve.opts(**curve_options(Axes(_TIME, quantity)), color=color, line_width=1.0)


def spectrum(
    found: Spectrum | Mapping[str, Spectrum], *, highest: float | None = None
) -> hv.Curve | hv.Overlay:
    """Density of acceleration over frequency in decibels re 1 (m/s²)²/Hz.

    Parameters
    ----------
    found
        one spectrum with one column, or several by words that distinguish them.
    highest
        [Hz] up to which it is drawn; None draws all.
    """
    if isinstance(found, Mapping):
        drawn = [
            _spectrum(one, words, color, highest)
            for (words, one), color in zip(
                found.items(), _repeated(style.DIRECTION_COLORS, len(found)), strict=True
            )
        ]
        axes = Axes(_FREQUENCY, _DENSITY)
        return hv.Overlay(drawn).opts(**curve_options(axes, legend_position="top_right"))
    curve = _spectrum(found, "", style.DEFECTIVE, highest)
    return curve.opts(**curve_options(Axes(_FREQUENCY, _DENSITY)))


_DENSITY = style.AxisQuantity("Density", "S", "dB re 1 (m/s²)²/Hz")


def _spectrum(found: Spectrum, label: str, color: str, highest: float | None) -> hv.Curve:
    density = np.asarray(found.density, dtype=float)
    if density.ndim != 1:
        raise checks.refuse("columns of density", density.shape, "one: a spectrum for each")
    shown = found.frequency > 0.0
    if highest is not None:
        shown &= found.frequency <= highest
    with np.errstate(divide="ignore"):
        level = 10.0 * np.log10(density[shown])
    curve = hv.Curve(
        (found.frequency[shown], _finite(level)),
        dimension("frequency", _FREQUENCY),
        dimension("density_db", _DENSITY),
        label=label,
    )
    return curve.opts(color=color, line_width=1.4)


def orbit(found: Orbit, *, n_points: int = 2000) -> hv.Path:
    """Where the middle of the inner ring goes in a period, seen along the shaft.

    Where there is no orbit the picture is empty and its title says why.
    """
    missing = {"x", "y"} - set(found.dofs)
    if missing:
        raise checks.refuse("dofs", found.dofs, "x and y among them")
    x, y = (style.AxisQuantity(f"Inner ring along {way}", "", "m", True) for way in "xy")
    time = np.linspace(0.0, found.period, n_points) if found.multipliers.size else np.zeros(0)
    place = found.inner_displacement(time) if time.size else np.zeros((0, len(found.dofs)))
    columns = [place[:, found.dofs.index(way)] for way in "xy"]
    title = found.status
    if found.multipliers.size:
        title += f", largest multiplier |μ| = {found.largest_multiplier:.3g}"
    path = hv.Path([tuple(columns)], [dimension("x", x), dimension("y", y)])
    options: dict[str, Any] = curve_options(Axes(x, y), width=420, height=400)
    return path.opts(**options, color=style.DEFECTIVE, line_width=1.8, title=title)


def _repeated(colors: tuple[str, ...], n: int) -> list[str]:
    return [colors[i % len(colors)] for i in range(n)]


def _finite(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(np.isfinite(values), values, np.nan)
