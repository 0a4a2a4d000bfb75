"""A healthy bearing with the usual speed and load of its size and kind."""

from __future__ import annotations

import dataclasses
import math

from bearingcore.bearings import BearingLike, bearing_of
from bearingcore.model.scene import Defect, Load, Scene, Support, presets
from bearingcore.model.statics._load_rating import dynamic_load_rating
from bearingcore.model.statics._thrust import facing, induced_thrust
from bearingcore.units import STANDARD_GRAVITY

SPEED_FACTOR = 150_000.0
"""n d_m [mm/min], a third of the limit of ball bearings in grease, half of that of tapered ones."""

LOAD_SHARE = 1.0 / 15.0
"""Radial load over the rating: machines are usually designed for C/P of 10 to 20."""

THRUST_SHARE = 1.3
"""Thrust over the thrust that the radial load induces; at 1, half of a row is idle."""


def scene_of(bearing: BearingLike) -> Scene:
    """Return a scene of a healthy bearing under a usual load and at a usual speed.

    The load is a fifteenth of the dynamic rating, downwards; a bearing that carries thrust one way
    only also has 1.3 times the thrust that this load induces. The shaft turns at n d_m = 150,000
    mm/min, on two bearings: its tilts are held. Loads [N] and speed [Hz] have three digits.

    Rotor and support are assumed, as no number of a bearing states them. The rotor weighs the
    radial load, and the housing is as heavy. Its springs are those of the fan rig, scaled with the
    size of the bearing: stiffness grows with length, and damping ratios stay. Natural frequencies
    and vibration are those of this assumed machine; enter the values of the real one to get its
    own.

    Parameters
    ----------
    bearing
        a bearing, or its designation: "6205".

    Raises
    ------
    ValueError
        for a text that is no designation, and for a bearing that ISO 281 does not rate: give it a
        `dynamic_load_rating`.

    Examples
    --------
    >>> scene = scene_of("6205")
    >>> round(scene.load.fy), round(scene.shaft_speed * 30.0 / math.pi)
    (-933, 3894)
    """
    known = bearing_of(bearing)
    rated = known.replace(ball_youngs_modulus=None, ball_poisson=None) if known.is_hybrid else known
    rating = known.dynamic_load_rating or dynamic_load_rating(rated)
    load = _rounded(LOAD_SHARE * rating)
    scene = Scene(
        bearing=known,
        defect=Defect.none(),
        load=Load(fy=-load),
        shaft_speed=2.0 * math.pi * _rounded(SPEED_FACTOR / (60e3 * known.pitch_diameter)),
        support=_scaled_support(load, known.pitch_diameter),
    )
    direction = facing(known)
    if not direction:
        return scene
    return scene.replace(fz=direction * _rounded(THRUST_SHARE * induced_thrust(scene)))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def _scaled_support(load: float, pitch_diameter: float) -> Support:
    """Return the fan rig's support, scaled to bodies that weigh a load [N] and a pitch circle."""
    rig = presets["fan-rig"]
    length = pitch_diameter / rig.bearing.pitch_diameter
    heavier = _rounded(load / STANDARD_GRAVITY) / rig.support.inner_mass
    damping = math.sqrt(heavier * length)
    factors = {"mass": heavier, "inertia": heavier, "stiffness": length, "damping": damping}
    scaled = {}
    for name, value in dataclasses.asdict(rig.support).items():
        tilts = "inertia" in name or name.endswith(("_rx", "_ry"))
        factor = next(factor for part, factor in factors.items() if part in name)
        scaled[name] = value * factor * (length**2 if tilts else 1.0)
    return Support(**scaled)
