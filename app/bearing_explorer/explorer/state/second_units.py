"""Second units: what else a number of the page is given and shown in.

A groove is also a ratio to its ball, a clearance also diametral, a speed also in turns a minute, a
defect also in millimetres along its race. Each is the number times a factor that the browser needs.
"""

from __future__ import annotations

import math
from typing import Any

from bearing_explorer.explorer.state.field_values import Values, defects_of
from bearingcore import Scene


def second_units(scene: Scene, selected: int, draft: Values) -> dict[str, dict[str, Any]]:
    """The second unit of quantities that have one, by name: its unit, words and factor.

    `draft`: dimensions that wait; the ratio of a groove among them is to the ball among them.
    """
    defect = defects_of(scene)[selected]
    on_race = 1e3 * defect.raceway_radius(scene.bearing) * math.pi / 180.0
    ball = 1e3 * scene.bearing.ball_diameter

    def unit_of(unit: str, words: str, factor: float) -> dict[str, Any]:
        return {"unit": unit, "words": words, "factor": factor}

    units = {
        "extent_deg": unit_of("mm", "along the race", on_race),
        "shaft_speed_hz": unit_of("rpm", "turns a minute", 60.0),
        "radial_clearance_um": unit_of("µm dia.", "diametral clearance", 2.0),
    }
    for race in ("inner", "outer"):
        name = f"{race}_groove_radius_mm"
        own = draft.get("ball_diameter_mm", ball) if name in draft else ball
        if own > 0.0:
            units[name] = unit_of("× ball", "groove radius over ball diameter", 1.0 / own)
    return units
