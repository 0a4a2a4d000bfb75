"""Scene: all inputs of a computation, as a value. Equal scenes give equal results."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from bearingcore.bearings import Bearing, BearingLike, bearing_of
from bearingcore.bearings._kind import DIRECTIONS
from bearingcore.bearings._kinds import recognize_kind
from bearingcore.bearings._line_contact import mend_factor
from bearingcore.bearings._preload import ROW_CHANGES
from bearingcore.common import _checks as checks, _scene_file as scene_file
from bearingcore.fields import FIELDS
from bearingcore.model.scene._defect import Defect, path_tables
from bearingcore.model.scene._floor import RoughFloor
from bearingcore.model.scene._load import Load
from bearingcore.model.scene._support import Support

DOF_NAMES = DIRECTIONS
DOF_SYMBOLS = {"x": "x", "y": "y", "z": "z", "rx": "θx", "ry": "θy"}
"""Displacements of the inner ring relative to the outer ring: along x, y, z, tilts about x, y."""

TILTS = ("rx", "ry")
TILT_HELD, TILT_FREE = "tilt held", "tilt free"
"""Choices of directions. `tilt free`: all that the scene needs, as if this bearing alone held the
shaft. `tilt held`: the same without tilts, as for a shaft on two bearings."""

FREE_TILT_WORDS = (
    "The shaft may tilt, as if this bearing alone held it; a second bearing would hold the tilt."
)
HELD_TILT_WORDS = "Tilt is held, as by a second bearing on the shaft."

LOAD_ALONG = {"x": "fx", "y": "fy", "z": "fz", "rx": "mx", "ry": "my"}
"""The field of `Load` along each direction."""

CONTACT_LAWS = ("published", "no tension")
"""`published`: viscous damping in every loaded contact (Eq. 18), which can pull a ball that leaves.
`no tension`: the same, but the force of a contact never pulls."""

MASSLESS, WITH_MASS = "massless", "with mass"
BALLS = (MASSLESS, WITH_MASS)
"""Models of balls in a simulated motion. `massless`: a ball is a spring between the rings (Eq. 13).
`with mass`: a ball has a position, inertia, centrifugal load, weight and two contacts."""


@dataclass(frozen=True)
class Scene:
    """A bearing, its defects, load, speed and support: all inputs of a computation.

    Parameters
    ----------
    bearing
        a `Bearing`, or a designation such as "6205": see `bearingcore.bearings._named.bearing_of`.
    load, support
        see `Load`, `Support`.
    defect
        a `Defect`, or a tuple of them.
    shaft_speed
        ω_s [rad/s], at least 0.
    contact_damping
        viscous damping c [N·s/m] of a loaded contact (Eq. 18). None: derived from the stiffness of
        the healthy bearing, see `bearingcore.contact_damping`.
    contact_law
        "published" or "no tension".
    dofs
        free directions out of ("x", "y", "z", "rx", "ry"). "tilt free": all directions that the
        load moves, including tilts, as if this bearing alone held the shaft. "tilt held": the same
        without tilts, as for a shaft on two bearings. None: "tilt free" if the load has a moment,
        which this bearing then carries, else "tilt held".
    balls
        "massless" or "with mass". With mass, simulated motions include the inertia of each ball,
        and `static_state` its centrifugal load at the scene's speed.
    unbalance
        U = m·e [kg·m] of the rotor, at least 0. In simulated motions the force U ω_s² on the inner
        ring turns with the shaft, along x at cage angle 0. Static answers leave it out.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    WANTED: ClassVar[str] = 'a Scene, such as scene_of("6205") or presets["fan-rig"]'
    """Words for a scene in the errors of `checks.instance`."""

    bearing: Bearing
    defect: Defect | tuple[Defect, ...]
    load: Load
    shaft_speed: float
    support: Support
    contact_damping: float | None = None
    contact_law: str = "published"
    dofs: tuple[str, ...] | str | None = None
    balls: str = dataclasses.field(default=MASSLESS, metadata=scene_file.LEFT_OUT)
    unbalance: float = dataclasses.field(default=0.0, metadata=scene_file.LEFT_OUT)

    if TYPE_CHECKING:  # types of the arguments, which are wider than those of the fields

        def __init__(
            self,
            bearing: BearingLike,
            defect: Defect | Iterable[Defect],
            load: Load,
            shaft_speed: float,
            support: Support,
            contact_damping: float | None = None,
            contact_law: str = "published",
            dofs: Iterable[str] | None = None,
            balls: str = MASSLESS,
            unbalance: float = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        checks.keep_number(self, "shaft_speed", at_least=0.0)
        checks.keep_number(self, "unbalance", at_least=0.0, unit="kg·m")
        checks.keep_number(self, "contact_damping", optional=True, at_least=0.0)
        checks.choice("contact_law", self.contact_law, CONTACT_LAWS)
        checks.choice("balls", self.balls, BALLS)
        choice = self.dofs if isinstance(self.dofs, str) else ""
        if self.dofs is not None and choice not in (TILT_HELD, TILT_FREE):
            checks.keep(self, dofs=check_dofs(self.dofs))
        if not isinstance(self.defect, Defect):
            several = (
                tuple(self.defect) if isinstance(self.defect, tuple | list) else (self.defect,)
            )
            for defect in several:
                checks.instance("defect", defect, Defect, "a Defect or a tuple of them")
            checks.keep(self, defect=tuple(several))
        checks.keep(self, bearing=bearing_of(self.bearing))
        checks.instance("load", self.load, Load)
        checks.instance("support", self.support, Support)
        if choice == TILT_HELD:
            checks.keep(self, dofs=self._held_dofs)
        self._check_directions()
        for defect in self.defects:
            defect.check(self.bearing)
        if len(self.defects) > 1:
            path_tables(self.defects, self.bearing)  # refuses defects that exclude each other

    def __repr__(self) -> str:
        """Return bearing, loads, speed and defects in a line."""
        loads = {name: getattr(self.load, name) for name in LOAD_ALONG.values()}
        parts = [
            repr(self.bearing).removeprefix("<Bearing: ").removesuffix(">"),
            ", ".join(f"{name} = {value:.4g}" for name, value in loads.items() if value),
            f"{30.0 / math.pi * self.shaft_speed:.5g} rpm",
            *(
                f"{defect.race} race damaged over {math.degrees(defect.extent):.4g}°, "
                f"{1e6 * defect.depth:.4g} µm deep"
                for defect in self.defects
            ),
        ]
        return f"<Scene: {'; '.join(filter(None, parts))}>"

    def _check_directions(self) -> None:
        """Refuse loads and directions that the kind of bearing cannot have."""
        kind = self.bearing.kind
        for direction, name in LOAD_ALONG.items():
            if direction not in kind.directions and (value := getattr(self.load, name)) != 0.0:
                raise checks.refuse(name, value, f"0: {kind.carries}")
        if isinstance(self.dofs, tuple):
            kind.check_directions(self.dofs)
        if self.balls == WITH_MASS:
            kind.check_mass()

    @property
    def defects(self) -> tuple[Defect, ...]:
        """The defects as a tuple, without empty ones."""
        several = (self.defect,) if isinstance(self.defect, Defect) else self.defect
        return tuple(defect for defect in several if not defect.is_none)

    @property
    def needed_dofs(self) -> tuple[str, ...]:
        """Directions that the load moves if this bearing alone holds the shaft.

        These are all five, unless fewer are exact. Under a radial load a bearing with zero contact
        angle is symmetric about the plane of the balls: z, rx and ry stay zero, and only x and y
        are needed. Some kinds of bearing have fewer directions, see `Kind.needed_directions`.
        """
        flat = self.bearing.is_flat
        radial = self.load.fz == self.load.mx == self.load.my == 0.0
        return DOF_NAMES[:2] if flat and radial else self.bearing.kind.needed_directions

    @property
    def _held_dofs(self) -> tuple[str, ...]:
        return tuple(name for name in self.needed_dofs if name not in TILTS)

    def tilt_words(self, dofs: Iterable[str] | None = None) -> str:
        """Return sentences on free or held tilts, and on loads that this bearing does not carry.

        The text is empty if the load causes no tilt and this bearing carries all of it.
        """
        free = self.free_dofs(dofs)
        if set(TILTS) & set(free):
            words = FREE_TILT_WORDS
        else:
            words = HELD_TILT_WORDS if set(TILTS) & set(self.needed_dofs) else ""
        loads = {name: getattr(self.load, LOAD_ALONG[name]) for name in DOF_NAMES}
        held = [LOAD_ALONG[name] for name in DOF_NAMES if loads[name] and name not in free]
        if held:
            words += f" Other parts of the machine carry {' and '.join(held)}, not this bearing."
        return words.lstrip()

    @property
    def active_dofs(self) -> tuple[str, ...]:
        """Directions of a computation, as `dofs` chooses them."""
        if isinstance(self.dofs, tuple):
            return self.dofs
        free = self.dofs == TILT_FREE or self.load.has_moment
        return self.needed_dofs if free else self._held_dofs

    def free_dofs(self, dofs: Iterable[str] | None = None) -> tuple[str, ...]:
        """Return the free directions of a computation: `dofs` if given, else `active_dofs`.

        "tilt free" means all directions that the scene needs, "tilt held" the same without tilts.

        Raises ValueError for unknown names, or directions in which the kind of bearing cannot move.
        """
        if dofs is None:
            return self.active_dofs
        if isinstance(dofs, str) and dofs in (TILT_HELD, TILT_FREE):
            return self._held_dofs if dofs == TILT_HELD else self.needed_dofs
        names = check_dofs(dofs)
        self.bearing.kind.check_directions(names)
        return names

    @property
    def cage_speed(self) -> float:
        """Cage speed ω_c [rad/s] by the bearing's main numbers (Eq. 3)."""
        return self.bearing.cage_speed(self.shaft_speed)

    @property
    def defect_turns(self) -> bool:
        """True if a defect turns with the shaft."""
        return any(defect.race == "inner" for defect in self.defects)

    @property
    def turning_force(self) -> float:
        """Force U ω_s² [N] of the unbalance; it turns with the shaft, along x at cage angle 0."""
        return self.unbalance * self.shaft_speed**2

    @property
    def holds_tilt_unasked(self) -> bool:
        """True if tilts that the load would cause are held because `dofs` is None."""
        return self.dofs is None and self.active_dofs != self.needed_dofs

    def with_tilts_as(self, choice: object) -> Self:
        """Return this scene with the tilts of its file or link, whose text of `dofs` is `choice`.

        Older files without `dofs` mean free tilts, the default of their time; newer files state
        that tilts are held.
        """
        if choice is None and self.holds_tilt_unasked:
            return dataclasses.replace(self, dofs=TILT_FREE)
        if choice == TILT_HELD and self.load.has_moment:
            return dataclasses.replace(self, dofs=TILT_HELD)
        return self

    def healthy(self) -> Scene:
        """Return the same scene without its defects."""
        return dataclasses.replace(self, defect=Defect.none())

    def to_data(self) -> dict[str, Any]:
        """Return the scene as dictionaries, lists, numbers and strings; None is left out."""
        defects = [scene_file.to_data(defect) for defect in self.defects]
        data = {"version": scene_file.VERSION, **scene_file.to_data(self), "defect": defects}
        # a file without `dofs` has free tilts, see `with_tilts_as`
        if self.holds_tilt_unasked:
            data["dofs"] = TILT_HELD
        elif self.dofs == TILT_FREE and self.replace(dofs=None).holds_tilt_unasked:
            del data["dofs"]
        kind = data["bearing"].pop("kind")
        if kind is not recognize_kind(self.bearing):
            data["bearing"]["kind"] = kind.name
        return data

    @classmethod
    def from_data(cls, data: object) -> Scene:
        """Make a scene from the result of `to_data`.

        Raises
        ------
        ValueError
            that names the table and field, its value and what is allowed.
        """
        table = scene_file.table("scene", data)
        version = table.pop("version", scene_file.VERSION)
        if version != scene_file.VERSION or isinstance(version, bool):
            raise checks.refuse("version", version, str(scene_file.VERSION))
        if table.get("defect", []) == []:
            table["defect"] = Defect.none()
        elif isinstance(table["defect"], list) and len(table["defect"]) == 1:
            table["defect"] = scene_file.from_data(Defect, "defect 1", table["defect"][0])
        table.setdefault("load", {})
        if isinstance(table.get("bearing"), dict):
            bearing = {"groove_center_distance": None} | table["bearing"]  # rollers have none
            if "load_deflection_factor" in bearing:
                bearing["load_deflection_factor"] = mend_factor(
                    bearing["load_deflection_factor"], bearing.get("roller_length")
                )
            table["bearing"] = bearing
        choice = table.get("dofs")
        if choice == TILT_HELD:
            table["dofs"] = None
        return scene_file.from_data(cls, "scene", table, top=True).with_tilts_as(choice)

    def to_toml(self) -> str:
        """Return the scene as TOML text for `from_toml`, in SI units and radians."""
        return scene_file.to_toml(self.to_data())

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """Make a scene from a TOML text.

        Raises
        ------
        ValueError
            that names the table and field, its value and what is allowed.
        """
        return cls.from_data(scene_file.from_toml(text))

    def replace(self, **changes: Any) -> Self:
        """Return a scene with changed fields, of the scene itself or of its parts, by name.

        >>> from bearingcore import presets
        >>> scene = presets["fan-rig"].replace(extent=0.2, fy=-50.0)
        >>> scene.defect.extent, scene.load.fy
        (0.2, -50.0)

        Fields of a defect, and of its rough floor, change the first of several defects. For fields
        of two rows see `Bearing.replace`.

        Raises
        ------
        ValueError
            for an unknown name, or a value that the part refuses.
        """
        fields: dict[str, Any] = {}
        inside: dict[str, dict[str, Any]] = {}
        for name, value in changes.items():
            if name in _OWN_FIELDS:
                fields[name] = value
            elif name in _PART_OF_FIELD:
                inside.setdefault(_PART_OF_FIELD[name], {})[name] = value
            else:
                known = ", ".join(sorted({*_OWN_FIELDS, *_PART_OF_FIELD}))
                raise checks.refuse("name of a field", name, known)
        if "bearing" in fields:
            fields["bearing"] = bearing_of(fields["bearing"])
        for part, values in inside.items():
            current = fields.get(part, getattr(self, part))
            if part == "defect" and not isinstance(current, Defect):
                first = _change_defect(current[0] if current else Defect.none(), values)
                fields[part] = (first, *current[1:])
            elif part == "defect":
                fields[part] = _change_defect(current, values)
            elif isinstance(current, Bearing):
                fields[part] = current.replace(**values)
            else:
                fields[part] = dataclasses.replace(current, **values)
        return dataclasses.replace(self, **fields)


_OWN_FIELDS = {field.name for field in dataclasses.fields(Scene)}
_PART_OF_FIELD = {
    field.name: part
    for part, kind in (
        ("bearing", Bearing),
        ("defect", Defect),
        ("load", Load),
        ("support", Support),
    )
    for field in dataclasses.fields(kind)
}
_PART_OF_FIELD |= dict.fromkeys(ROW_CHANGES, "bearing")
_OF_FLOOR = {field.name for field in FIELDS if field.part == "floor"}
_PART_OF_FIELD |= dict.fromkeys(_OF_FLOOR, "defect")


def _change_defect(defect: Defect, values: dict[str, Any]) -> Defect:
    """Return a defect with changed fields, of itself or of its rough floor."""
    of_floor = {name: values[name] for name in values if name in _OF_FLOOR}
    of_defect = {name: values[name] for name in values if name not in _OF_FLOOR}
    defect = dataclasses.replace(defect, **of_defect)
    if not of_floor:
        return defect
    if not isinstance(defect.floor, RoughFloor):
        words = "left out, unless the floor of the defect is a RoughFloor"
        raise checks.refuse(*next(iter(of_floor.items())), words)
    return dataclasses.replace(defect, floor=dataclasses.replace(defect.floor, **of_floor))


def check_dofs(dofs: Iterable[str]) -> tuple[str, ...]:
    """Return `dofs` in the order of `DOF_NAMES`; ValueError for unknown, repeated or no names."""
    allowed = "different names out of " + ", ".join(DOF_NAMES)
    if not isinstance(dofs, Iterable):
        raise checks.refuse("dofs", dofs, allowed)
    names = (dofs,) if isinstance(dofs, str) else tuple(dofs)
    known = all(name in DOF_NAMES for name in names)
    if not names or not known or len(set(names)) != len(names):
        raise checks.refuse("dofs", names, allowed)
    return tuple(name for name in DOF_NAMES if name in names)
