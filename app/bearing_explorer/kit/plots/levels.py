"""Levels of vibration over frequency, as all spectra of the page draw them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style
from bearingcore import Spectrum

FREQUENCY = style.AxisQuantity("Frequency", "f", "Hz")
SHOWN = ("x", "y")
HIGHEST = 2500.0  # [Hz] of the picture, more where a band or a peak lies higher
DEPTH_OF_VIEW = 60.0  # [dB] below the loudest line
LEVEL_FLOOR = -200.0  # [dB] the level of a housing that does not move at all


def decibels(density: Any) -> Any:
    """Level of a density [(m/s²)²/Hz] in dB re 1 (m/s²)²/Hz; silence is `LEVEL_FLOOR`."""
    return 10.0 * np.log10(np.maximum(density, 10.0 ** (LEVEL_FLOOR / 10.0)))


def drawn_levels(
    spectra: Mapping[str, Spectrum], top: float, lowest: float = 0.0
) -> dict[str, NDArray[np.float64]]:
    """Return the levels [dB] of the directions shown from `lowest` up to `top` [Hz].

    NaN for a direction that is not free; empty without spectra.
    """
    if not spectra:
        return {name: np.zeros(0) for name in ("frequency", *SHOWN)}
    frequency = next(iter(spectra.values())).frequency
    shown = (frequency >= lowest) & (frequency <= top)
    missing = np.full(int(shown.sum()), np.nan)
    return {
        "frequency": frequency[shown],
        **{
            dof: decibels(spectra[dof].density[shown]) if dof in spectra else missing
            for dof in SHOWN
        },
    }


def seen_levels(
    room: float, *spectra: Mapping[str, np.ndarray], depth: float = DEPTH_OF_VIEW
) -> tuple[NDArray[np.float64], float]:
    """Return the levels [dB] that an axis has to show, and its top, `room` above the loudest.

    Levels more than `depth` below the loudest line count as silence, and are cut off there.
    """
    levels = np.concatenate([spectrum[dof] for spectrum in spectra for dof in SHOWN])
    loudest = float(np.nanmax(levels, initial=LEVEL_FLOOR))
    return np.maximum(levels, loudest - depth), loudest + room
