"""Options of a simulated measurement, on the page and in lessons."""

from __future__ import annotations

import math
from collections.abc import Mapping

NOISES: Mapping[str, float] = {"40": 40.0, "20": 20.0, "10": 10.0, "none": math.inf}
"""Signal over noise [dB] of simulated measurements."""

MACHINES = ("same", "different")
"""Whether the measured machine has the numbers of the scene, or only about those."""

PITS: Mapping[str, float | None] = {"scene": None, "0.2": 2e-4, "0.3": 3e-4, "0.5": 5e-4}
"""Defect of the measured race: the scene's own defect, or a small pit so long [m], with the edges
that geometry asks for and balls that have mass: as pits that are seeded on test rigs."""
