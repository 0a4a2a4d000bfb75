"""A scene's bearing for rotors in ROSS (Rotordynamic Open Source Software), an optional package."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks
from bearingcore.model.dynamics._damping import contact_damping
from bearingcore.model.dynamics._modes import loaded_directions
from bearingcore.model.scene import WITH_MASS, Scene
from bearingcore.model.statics import static_state
from bearingcore.model.statics._positions import over_all_positions

ALONG = {
    "xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1), "zz": (2, 2),
}  # fmt: skip
"""Row and column of each coefficient of a bearing in ROSS, which has the axes of a scene."""

MISSING = 'to_ross needs ROSS, which is not installed: pip install "bearing-explorer[ross]"'
AXES = {"2": "frequency", "3": "speed"}
"""Argument of `ross.BearingElement` for shaft speeds, by ROSS's first version number. In ROSS 3
`frequency` is that of the whirl."""


def to_ross(scene: Scene, speeds: ArrayLike, *, node: int = 0, **more: Any) -> Any:
    """Return the bearing of `scene` as a `ross.BearingElement`, with coefficients over shaft speed.

    At each speed the balls carry their centrifugal load, also if the scene has massless balls
    (`ball_positions`). Rollers have no known mass; their stiffness is the same at all speeds. The
    coefficients along x, y and z are means over the cage angles, because balls pass faster than the
    rotor turns: K_b (Eq. 17) and c Σ e e' of the loaded balls (Eq. 27). ROSS has neither k_xz and
    k_yz nor tilts, which the shaft is assumed to prevent. The support is not included: link the
    element to a node of the housing.

    Parameters
    ----------
    scene
        the scene, with bearing, defect, load and directions.
    speeds : (n,)
        shaft speeds [rad/s], increasing. Between them ROSS interpolates, beyond them it
        extrapolates.
    node
        node of the rotor at the bearing.
    more
        other arguments of `ross.BearingElement`, such as `n_link` and `tag`.

    Raises
    ------
    ImportError
        if ROSS is not installed (the extra "ross" installs it), or is neither ROSS 2 nor 3.
    ValueError
        for speeds that are negative or do not increase, or a cage angle without a static state.
    """
    checks.instance("scene", scene, Scene)
    try:
        import ross  # imported late: optional, and slow
    except ImportError as error:
        raise ImportError(MISSING) from error
    axis = AXES.get(ross.__version__.split(".")[0])
    if axis is None:
        raise ImportError(f"to_ross knows ROSS 2 and 3; this is ROSS {ross.__version__}")
    speeds = np.atleast_1d(checks.finite("speeds", speeds, "rad/s"))
    if speeds.size == 0 or speeds[0] < 0.0 or (np.diff(speeds) <= 0.0).any():
        raise checks.refuse("speeds", speeds.tolist(), "at least 0 rad/s and increasing")
    means = [_mean_matrices(scene.replace(shaft_speed=float(speed))) for speed in speeds]
    coefficients = {
        f"{letter}{name}": np.array([matrices[k][place] for matrices in means])
        for k, letter in enumerate("kc")
        for name, place in ALONG.items()
    }
    return ross.BearingElement(n=node, **{axis: speeds}, **coefficients, **more)


def _mean_matrices(scene: Scene) -> tuple[Array, Array]:
    """Return the means of K_b and C_b (5, 5) over all positions; balls have mass if it is known."""
    if not scene.bearing.kind.mass_unknown:
        scene = scene.replace(balls=WITH_MASS)
    state = over_all_positions(scene, solve=static_state)
    if not state.converged.all():
        k = int(np.argmin(state.converged))
        raise checks.refuse(
            "scene", f"at {scene.shaft_speed:g} rad/s {state.reason(k)}", "one static state"
        )
    damping = contact_damping(scene) * loaded_directions(state)
    stiffness = np.tensordot(state.shares, state.stiffness, 1)
    return stiffness, np.tensordot(state.shares, damping, 1)
