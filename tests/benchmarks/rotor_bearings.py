"""The ball bearing of rotor dynamics, Friswell's closed form, beside this program's.

    python -m tests.benchmarks.rotor_bearings    # writes the table of assets/docs/ACCURACY.md

M. I. Friswell et al., Dynamics of Rotating Machines (2010), pages 182-185, as ROSS has it in
`BallBearingElement`: no clearance, no load zone, no grooves.
"""

import math

import numpy as np

from bearingcore import Scene, equilibrium, presets
from bearingcore.common import number
from bearingcore.model.statics import default_cage_angles
from tests.benchmarks.charts import DOCUMENT, put

PRESETS = ("6205", "6206", "fan-rig")
LOADS = (100.0, 1000.0)
MARK = "rotor bearings"

FACTOR = 13e6
"""[N^(2/3) m^(-4/3)] of the stiffness along the load."""
RATIOS = {8: 0.46, 12: 0.64, 16: 0.73}
"""Stiffness across the load over that along it, by number of balls."""


def friswell(
    n_balls: int, ball_diameter: float, load: float, contact_angle: float
) -> tuple[float, float]:
    """Stiffness [N/m] across and along a load [N], by the closed form; lengths [m], angles [rad].

    The ratio goes through the three that are printed as a parabola, as in ROSS.
    """
    along = FACTOR * (n_balls**2 * ball_diameter * load * math.cos(contact_angle) ** 5) ** (1 / 3)
    ratio = np.polyval(np.polyfit(list(RATIOS), list(RATIOS.values()), 2), n_balls)
    return float(ratio) * along, along


def radially_loaded(preset: str, load: float) -> Scene:
    """The bearing of a preset without defect, a load [N] pressing down on it."""
    return presets[preset].healthy().replace(fx=0.0, fy=-load, fz=0.0, mx=0.0, my=0.0)


def mean_stiffness(scene: Scene) -> tuple[float, float, float]:
    """Means over the cage angles: k_xx, k_yy [N/m] and the number of loaded balls."""
    state = equilibrium(scene, default_cage_angles(scene)[:-1])
    means = (state.term("k_xx"), state.term("k_yy"), state.loaded_balls)
    xx, yy, loaded = (float(values.mean()) for values in means)
    return xx, yy, loaded


def rows_and_sentence() -> str:
    """Rows of bearings and loads as Markdown, stiffness in N/µm, and a sentence."""
    ratios = []
    rows = [
        ["bearing", "load", "closed form, across and along", "here, without clearance",
         "here", "loaded balls", "closed form over ours, across", "along"],
        ["---", *["---:"] * 7],
    ]  # fmt: skip
    for preset in PRESETS:
        for load in LOADS:
            scene = radially_loaded(preset, load)
            own = scene.bearing
            theirs = friswell(own.n_balls, own.ball_diameter, load, own.contact_angle)
            closed = mean_stiffness(scene.replace(radial_clearance=0.0))
            xx, yy, loaded = mean_stiffness(scene)
            ratios.append(theirs[0] / xx)
            rows.append([
                preset, f"{load:.0f} N", _pair(*theirs), _pair(*closed[:2]), _pair(xx, yy),
                f"{loaded:.1f} of {own.n_balls}", f"{theirs[0] / xx:.2f}", f"{theirs[1] / yy:.2f}",
            ])  # fmt: skip
    lines = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    extremes = f"{min(ratios):.2f} to {max(ratios):.2f}"
    return f"{lines}\n\nAcross the load the closed form is {extremes} times as stiff."


def _pair(across: float, along: float) -> str:
    return f"{number(across / 1e6, 3)} and {number(along / 1e6, 3)}"


def document(text: str) -> str:
    """The document with the table in it."""
    return put(text, MARK, rows_and_sentence())


if __name__ == "__main__":
    DOCUMENT.write_text(document(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
