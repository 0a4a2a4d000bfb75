"""How a measurement may be simulated: what the page offers and lessons ask for."""

from __future__ import annotations

import math
from collections.abc import Mapping

NOISES: Mapping[str, float] = {"40": 40.0, "20": 20.0, "10": 10.0, "none": math.inf}
"""Signal over noise [dB] of simulated measurements."""

MACHINES = ("same", "different")
"""Whether the measured machine has the numbers of the scene, or only about those."""
