"""From one kind of bearing to another: what is kept, what is assumed, what a scene then leaves out.

Dimensions that both kinds have are kept. What the new kind needs besides is assumed, and is there
to be changed.
"""

from __future__ import annotations

import dataclasses
import math

from bearing_explorer.state.choice_list import kind_of
from bearing_explorer.state.quantities import defects_of
from bearing_explorer.state.quantity_list import QUANTITY_LIST
from bearingcore import Bearing, Scene
from bearingcore.bearings.rows import ARRANGEMENTS

USUAL_ALIGNING_ANGLE = math.radians(10.0)
USUAL_GROOVE = 0.53
"""Inner groove radius of a self-aligning bearing, and outer one of others, over the ball."""
ROWS_APART = 1.5
"""Distance of the rows of a new pair, in ball diameters."""

MOST_SHOWN_ROWS = 2


def as_kind(bearing: Bearing, kind: str) -> Bearing:
    """The bearing nearest to `bearing` that is of a kind.

    Raises
    ------
    ValueError
        where there is none.
    """
    if kind == kind_of(bearing):
        return bearing
    if kind == "rollers":
        return Bearing.cylindrical(
            bearing.n_balls,
            bearing.ball_diameter,
            bearing.ball_diameter,
            bearing.pitch_diameter,
            bearing.radial_clearance,
        )
    if kind == "self-aligning":
        return _aligning(bearing)
    single = _single(bearing)
    if kind == "single":
        return single
    assert kind in ARRANGEMENTS
    distance, preload = bearing.row_distance, bearing.preload
    pair = single.paired(
        ROWS_APART * bearing.ball_diameter if distance is None else distance,
        kind,
        0.0 if kind == "tandem" or preload is None else preload,
    )
    if bearing.rows_are_alike or len(bearing.rows) != len(pair.rows):
        return pair
    rows = (
        dataclasses.replace(new, **old.own)  # type: ignore[arg-type]  # names and kinds of its own
        for new, old in zip(pair.rows, bearing.rows, strict=True)
    )
    return dataclasses.replace(pair, rows=tuple(rows))


def _single(bearing: Bearing) -> Bearing:
    """One row with the balls of a bearing; of rollers and in a sphere its grooves are assumed."""
    if not (bearing.is_roller or bearing.is_self_aligning):
        return dataclasses.replace(bearing, rows=())
    ball = bearing.ball_diameter
    inner = bearing.sphere_groove if bearing.is_self_aligning else 0.52 * ball
    return Bearing.from_drawing(
        bearing.n_balls,
        ball,
        bearing.pitch_diameter,
        inner,
        USUAL_GROOVE * ball,
        contact_angle=bearing.contact_angle,
        diametral_clearance=2.0 * bearing.radial_clearance,
    )


def _aligning(bearing: Bearing) -> Bearing:
    ball = bearing.ball_diameter
    angle = bearing.contact_angle or USUAL_ALIGNING_ANGLE
    known = bearing.inner_groove_radius
    return Bearing.self_aligning(
        bearing.n_balls,
        ball,
        0.5 * bearing.pitch_diameter / math.cos(angle) + 0.5 * ball,
        USUAL_GROOVE * ball if known is None else known,
        angle,
        bearing.radial_clearance,
    )


def scene_with(scene: Scene, bearing: Bearing) -> Scene:
    """A scene with another bearing in it, without what that one cannot have.

    Rollers carry no load along the shaft and no moment and move along x and y; defects of a row
    that is not there lie in all rows.

    Raises
    ------
    ValueError
        for a defect that the bearing cannot have.
    """
    rows = len(bearing.all_rows)
    defects = tuple(
        dataclasses.replace(defect, row=None)
        if defect.row is not None and (defect.row >= rows or rows == 1)
        else defect
        for defect in defects_of(scene)
    )
    load, dofs = scene.load, scene.dofs
    if bearing.is_roller:
        load = dataclasses.replace(load, fz=0.0, mx=0.0, my=0.0)
        kept = tuple(name for name in dofs or () if name in ("x", "y"))
        dofs = kept or None
    elif kind_of(bearing) != kind_of(scene.bearing) and scene.bearing.is_roller:
        dofs = None
    return dataclasses.replace(
        scene,
        bearing=bearing,
        defect=defects[0] if len(defects) == 1 else defects,
        load=load,
        dofs=dofs,
    )


#: what each kind's bearing does not have, or what follows there from the rest
_OF_ROWS = ("row_distance_mm", "preload_um")
_OF_SECOND_ROW = tuple(q.name for q in QUANTITY_LIST if q.group == "Second row")
_CONTACT_NUMBERS = (
    "groove_center_distance_um",
    "groove_center_radius_mm",
    "load_deflection_factor",
    "inner_raceway_radius_mm",
)
_MATERIAL = ("outer_groove_radius_mm", "youngs_modulus_gpa", "poisson")


def hidden_of(bearing: Bearing) -> list[str]:
    """Controls that do not belong to this kind of bearing."""
    kind = kind_of(bearing)
    hidden = [] if bearing.rows else ["row"]
    if not bearing.arrangement:
        hidden += _OF_SECOND_ROW
    elif not bearing.is_drawn:  # nothing follows from dimensions there
        hidden += [name for name in _OF_SECOND_ROW if name.endswith("_mm")]
    if kind == "rollers":
        return [
            *hidden,
            *_OF_ROWS,
            *_CONTACT_NUMBERS,
            *_MATERIAL,
            *("inner_groove_radius_mm", "contact_angle_deg", "outer_raceway_radius_mm", "numbers"),
            *("fz_n", "mx_nm", "my_nm"),
        ]
    hidden.append("roller_length_mm")
    if kind == "self-aligning":
        return [*hidden, *_OF_ROWS, *_CONTACT_NUMBERS, *_MATERIAL, "pitch_diameter_mm", "numbers"]
    if not bearing.arrangement:
        hidden += _OF_ROWS
    elif kind == "tandem":
        hidden.append("preload_um")
    derived = (*_CONTACT_NUMBERS, "outer_raceway_radius_mm")
    return [*hidden, *(derived if bearing.is_drawn else (*_MATERIAL, "inner_groove_radius_mm"))]
