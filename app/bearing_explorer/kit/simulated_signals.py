"""Noise of a simulated measurement, on the page and in lessons."""

from __future__ import annotations

import math
from collections.abc import Mapping

NOISES: Mapping[str, float] = {"40": 40.0, "20": 20.0, "10": 10.0, "none": math.inf}
"""Signal-to-noise ratio [dB] of simulated measurements, by name."""
