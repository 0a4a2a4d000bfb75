"""A stability map of a few points."""

from __future__ import annotations

import numpy as np
from bearing_explorer.explorer.state.value_range import SWEEPABLE, Sweep
from bearing_explorer.explorer.views.swept_view import Swept

from bearingcore import presets
from bearingcore.dynamics.stability_maps import stability_map

RIG = presets["fan-rig"].replace(contact_damping=130.0)


def found_map() -> Swept:
    x = Sweep(SWEEPABLE["shaft_speed_hz"], np.array([10.0, 20.0, 30.0]))
    y = Sweep(SWEEPABLE["extent_deg"], np.array([12.9, 38.6]))
    return Swept(stability_map(RIG, x.in_si, y.in_si), (x, y))
