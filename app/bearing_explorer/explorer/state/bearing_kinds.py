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
    """Convert a bearing to another kind, named by its option.

    Dimensions that both kinds have are kept. Further dimensions of the new kind are assumed, and a
    person can change them. ValueError if there is no such bearing.
    """
    if variant == bearing.kind.variant(bearing):
        return bearing
    converted = convert_bearing(bearing, variant)
    rating = bearing.dynamic_load_rating if converted.rated == bearing.rated else None
    return dataclasses.replace(converted, estimated=bearing.estimated, dynamic_load_rating=rating)


def scene_with(scene: Scene, bearing: Bearing) -> Scene:
    """Put another bearing into a scene, and drop what this bearing cannot have.

    Loads and directions that its kind lacks are left out. If it lacks the row of a defect, the
    defect lies in all rows. ValueError for a defect that the bearing cannot have.
    """
    rows = len(bearing.all_rows)
    defects = tuple(
        dataclasses.replace(defect, row=None)
        if defect.row is not None and (defect.row >= rows or rows == 1)
        else defect
        for defect in defects_of(scene)
    )
    before, now = scene.bearing.kind.directions, bearing.kind.directions
    dofs = scene.dofs if bearing.rows or scene.dofs != TILT_FREE else None  # one row alone may tip
    if isinstance(dofs, tuple):  # a choice among fewer directions is void
        dofs = None if set(now) - set(before) else tuple(name for name in dofs if name in now)
    return dataclasses.replace(
        scene,
        bearing=bearing,
        defect=defects[0] if len(defects) == 1 else defects,
        load=dataclasses.replace(scene.load, **dict.fromkeys(_loads_not_carried(bearing), 0.0)),
        dofs=dofs or None,
        balls=MASSLESS if bearing.kind.mass_unknown else scene.balls,
    )


def add_thrust(scene: Scene) -> tuple[Scene, str]:
    """Add an axial load to a scene whose rows face one way; return a sentence on it too.

    A row with a contact angle, and rows in tandem, carry a radial load only with an axial one. This
    is added if the scene has none, and tilts are held, as by the shaft's other bearing. If nothing
    is added the sentence is empty.
    """
    bearing, load = scene.bearing, scene.load
    thrust = 2.0 * math.tan(bearing.contact_angle) * math.hypot(load.fx, load.fy)
    one_way = not bearing.rows or bearing.arrangement == "tandem"
    needs_thrust = one_way and "z" in bearing.kind.directions and thrust > 0.0
    if load.fz != 0.0 or not needs_thrust:
        return scene, ""
    words = (
        f"Added, as such a bearing needs it: an axial load of {number(thrust)} N, and a shaft that "
        "another bearing keeps from tilting."
    )
    return scene.replace(fz=float(f"{thrust:.3g}"), dofs=None), words


def _loads_not_carried(bearing: Bearing) -> list[str]:
    """Fields of the load that a kind of bearing cannot carry."""
    carried = bearing.kind.directions
    return [load for direction, load in LOAD_ALONG.items() if direction not in carried]


def hidden_of(bearing: Bearing) -> list[str]:
    """Names of the controls that this kind of bearing does not have."""
    inputs = bearing.kind.inputs(bearing)
    not_carried = _loads_not_carried(bearing)
    hidden = [
        field.key
        for field in SHOWN_FIELDS
        if (field.group in BEARING_GROUPS and field.full_name not in inputs)
        or field.full_name in not_carried
    ]
    choices = {
        "row": len(bearing.all_rows) > 1,
        "numbers": bearing.kind.has_drawing,
        "ball_material": bearing.is_drawn,
        "balls": not bearing.kind.mass_unknown,
    }
    return hidden + [name for name, shown in choices.items() if not shown]
