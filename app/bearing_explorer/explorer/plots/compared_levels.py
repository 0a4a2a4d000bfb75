"""Spectra of compared scenes."""

from __future__ import annotations

import numpy as np

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots import compared_curves
from bearing_explorer.kit.plots.levels import SHOWN, drawn_levels


def levels_of_compared(
    name: str, results: Results, top: float, lowest: float = 0.0
) -> dict[str, dict[str, np.ndarray]]:
    """Spectra of the compared scenes from `lowest` to `top` [Hz], for `compared_curves`."""
    return compared_curves.sources(
        name,
        ("frequency", *SHOWN),
        results.compared_results,
        lambda other: drawn_levels(other.late_spectra, top, lowest),
    )
