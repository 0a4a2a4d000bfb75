"""Change of the kind of a bearing, and the controls that a kind has."""

from __future__ import annotations

import dataclasses
import math

from bearing_explorer.explorer.state.field_values import BEARING_GROUPS, SHOWN_FIELDS, defects_of
from bearingcore import Bearing, Scene
from bearingcore.bearings import convert_bearing
from bearingcore.common import number
from bearingcore.model.scene import LOAD_ALONG, MASSLESS, TILT_FREE

MOST_SHOWN_ROWS = 2


def convert_to_kind(bearing: Bearing, variant: str) -> Bearing:
    """The bearing nearest to `bearing` that is of a kind, by the name of its option.

    Dimensions that both kinds have are kept; what the new kind needs besides is assumed, and is
    there to be changed.

    Raises
    ------
    ValueError
        where there is none.
    """
    if variant == bearing.kind.variant(bearing):
        return bearing
    made = convert_bearing(bearing, variant)
    rating = bearing.dynamic_load_rating if made.rated == bearing.rated else None
    return dataclasses.replace(made, estimated=bearing.estimated, dynamic_load_rating=rating)


def scene_with(scene: Scene, bearing: Bearing) -> Scene:
    """A scene with another bearing in it, without what that one cannot have.

    Loads and directions that the kind of bearing has not are left out; defects of a row that is
    not there lie in all rows.

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
    before, now = scene.bearing.kind.directions, bearing.kind.directions
    dofs = scene.dofs if bearing.rows or scene.dofs != TILT_FREE else None  # one row may tip over
    if isinstance(dofs, tuple):  # where they were all that the other kind had they are no choice
        dofs = None if set(now) - set(before) else tuple(name for name in dofs if name in now)
    return dataclasses.replace(
        scene,
        bearing=bearing,
        defect=defects[0] if len(defects) == 1 else defects,
        load=dataclasses.replace(scene.load, **dict.fromkeys(_loads_without(bearing), 0.0)),
        dofs=dofs or None,
        balls=MASSLESS if bearing.kind.mass_unknown else scene.balls,
    )


def add_thrust(scene: Scene) -> tuple[Scene, str]:
    """A scene in which rows that face one way are pushed together, and a sentence on it.

    A row with a contact angle, and rows in tandem, carry a radial load only with an axial one,
    which is added where the scene has none; tilts are held, as by the shaft's other bearing. No
    sentence where nothing is.
    """
    bearing, load = scene.bearing, scene.load
    thrust = 2.0 * math.tan(bearing.contact_angle) * math.hypot(load.fx, load.fy)
    one_way = not bearing.rows or bearing.arrangement == "tandem"
    alone = one_way and "z" in bearing.kind.directions
    if load.fz != 0.0 or not (alone and thrust > 0.0):
        return scene, ""
    words = (
        f"Added, as such a bearing needs it: an axial load of {number(thrust)} N, and a shaft that "
        "another bearing keeps from tilting."
    )
    return scene.replace(fz=float(f"{thrust:.3g}"), dofs=None), words


def _loads_without(bearing: Bearing) -> list[str]:
    """Fields of the load that a kind of bearing cannot carry."""
    able = bearing.kind.directions
    return [load for direction, load in LOAD_ALONG.items() if direction not in able]


def hidden_of(bearing: Bearing) -> list[str]:
    """Controls that do not belong to this kind of bearing."""
    inputs = bearing.kind.inputs(bearing)
    without = _loads_without(bearing)
    hidden = [
        field.key
        for field in SHOWN_FIELDS
        if (field.group in BEARING_GROUPS and field.full_name not in inputs)
        or field.full_name in without
    ]
    choices = {
        "row": len(bearing.all_rows) > 1,
        "numbers": bearing.kind.has_drawing,
        "ball_material": bearing.is_drawn,
        "balls": not bearing.kind.mass_unknown,
    }
    return hidden + [name for name, shown in choices.items() if not shown]
