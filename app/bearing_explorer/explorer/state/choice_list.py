"""The choices of the page that have a list of options, and the fields of a scene that they set.

Controls, allowed messages of the browser, links and lessons all come from this table. A choice that
sets a field of a scene or of its defects needs an entry here and nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bearing_explorer.explorer.state.field_values import defects_of
from bearingcore import MeasuredFloor, RoughFloor, Scene
from bearingcore.bearings import KINDS
from bearingcore.model.scene import TILT_FREE

NOTHING = object()
"""Marks an option whose value in the core is None."""


@dataclass(frozen=True)
class Option:
    """One option: its name in messages, links and lessons, and its words on the page.

    `in_core` is its value in the core if that differs from the name.
    """

    name: str
    label: str
    about: str
    in_core: Any = None

    @property
    def value(self) -> Any:
        """The value of the scene's field."""
        if self.in_core is NOTHING:
            return None
        return self.name if self.in_core is None else self.in_core


@dataclass(frozen=True)
class Choice:
    """One choice of the page.

    Parameters
    ----------
    group
        group of quantities among which it is shown; `first`: before their sliders.
    of
        "defect" if it sets a field of a defect; "scene" if it sets a field of the scene, its
        bearing, load or support; empty if a method of `SceneEditor` carries it out.
    field
        name of that field.
    all_alike
        True if all defects must have the same option.
    in_lessons
        True if a lesson can set it.
    lesson_control
        True if it can be a control of a lesson.
    """

    name: str
    label: str
    group: str
    options: tuple[Option, ...]
    of: str = ""
    field: str = ""
    first: bool = False
    all_alike: bool = False
    in_lessons: bool = True
    lesson_control: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the options."""
        return tuple(option.name for option in self.options)

    @property
    def link_options(self) -> Mapping[str, Any]:
        """Values by their names in links, with hyphens for spaces."""
        return {option.name.replace(" ", "-"): option.value for option in self.options}

    def value_of(self, name: str) -> Any:
        """Value of the field for the option of this name."""
        return next(option.value for option in self.options if option.name == name)

    def name_of(self, owner: Any) -> str:
        """Name of the option that a scene or a defect has."""
        if isinstance(owner, Scene):
            parts = (owner, owner.bearing, owner.load, owner.support)
            owner = next(part for part in parts if hasattr(part, self.field))
        value = getattr(owner, self.field)
        return next(option.name for option in self.options if option.value == value)


RACE = Choice(
    "race",
    "Race",
    "Defect",
    (
        Option("outer", "Outer", "The outer ring is at rest, and its defect too."),
        Option(
            "inner",
            "Inner, turns",
            "The inner ring turns with the shaft. Curves are then drawn over a turn of the "
            "shaft, as the defect meets the balls in other places with each turn of the cage.",
        ),
    ),
    of="defect",
    field="race",
    first=True,
    lesson_control=True,
)

ROW = Choice(
    "row",
    "Row",
    "Defect",
    (
        Option("all", "All rows", "It reaches across all rows of balls.", NOTHING),
        Option("1", "Row 1", "Only the balls of the first row meet it, lowest on the shaft.", 0),
        Option("2", "Row 2", "Only the balls of the second row meet it.", 1),
    ),
    of="defect",
    field="row",
    first=True,
    lesson_control=True,
)

EDGE = Choice(
    "edge",
    "How a ball rolls over the edge",
    "Defect",
    (
        Option(
            "published",
            "As in the paper (Eq. 6)",
            "Eq. 6 with its factor 0.25: a ball sinks less than geometry asks for, but the "
            "paper's figures were made with it.",
        ),
        Option(
            "chord",
            "Chord, whole arc",
            "Eq. 6 without the factor 0.25: the ball follows a straight chord between the edges.",
        ),
        Option(
            "exact",
            "Exact, curved race",
            "A ball that pivots on the corner of the curved race.",
        ),
    ),
    of="defect",
    field="edge",
    all_alike=True,  # defects that run into one another need one edge model
    lesson_control=True,
)

FLOOR = Choice(
    "floor",
    "Floor",
    "Defect",
    (
        Option("flat", "Flat", "The same depth everywhere."),
        Option(
            "rough",
            "Rough",
            "Random heights about the depth. The centre of a ball follows the ball's circle "
            "rolled over them.",
        ),
        Option(
            "measured",
            "Measured",
            "Measured points, which come with a scene's link or file; the sliders stretch them.",
        ),
    ),
    lesson_control=True,
)

LAW = Choice(
    "law",
    "Contact law",
    "Contacts in motion",
    (
        Option(
            "published",
            "As in the paper (can pull: not physical)",
            "Viscous damping in every loaded contact (Eq. 18). As a ball leaves, it can pull.",
        ),
        Option(
            "no tension",
            "Without tension",
            "The same damping, but a contact never pulls: its force ends at zero.",
        ),
    ),
    of="scene",
    field="contact_law",
)

BALLS = Choice(
    "balls",
    "Balls",
    "Turning",
    (
        Option(
            "massless",
            "Massless",
            "Each ball is a spring between the rings, as in the paper. Exact at low frequencies; "
            "the status line says up to which frequency.",
        ),
        Option(
            "with mass",
            "With mass",
            "Each ball has its own place, its inertia, centrifugal load and weight, and a contact "
            "with each race: it can lift off and strike. Loads and stiffness at rest count the "
            "centrifugal load; maps and natural frequencies leave it out.",
        ),
    ),
    of="scene",
    field="balls",
    lesson_control=True,
)

IN_PART = "in part"
DIRECTIONS = Choice(
    "dofs",
    "Shaft",
    "Bodies",
    (
        Option(
            "auto",
            "On two bearings: tilt held",
            "It does not tilt: the scene takes the fewest directions that are exact for it.",
            NOTHING,
        ),
        Option(
            TILT_FREE,
            "On this bearing alone: tilt free",
            "It may tilt, and a bearing carries less then.",
        ),
        Option(
            IN_PART,
            "Held in some directions by choice",
            "As a link or a file has it.",
        ),
    ),
    first=True,
    in_lessons=False,
)

NUMBERS = Choice(
    "numbers",
    "Given as",
    "",
    (
        Option(
            "direct",
            "Numbers of the contact model",
            "As the paper prints them: groove centres, clearance and load-deflection factor are "
            "given.",
        ),
        Option(
            "drawing",
            "A drawing",
            "Groove radii and material are given; groove centres, raceway radii and the "
            "load-deflection factor follow from them (Hertz). Contact angle and clearance describe "
            "the same freedom: give one and leave the other 0, or give both, as the paper does.",
        ),
    ),
    first=True,
    in_lessons=False,
)

MATERIAL = Choice(
    "ball_material",
    "Balls of",
    "",
    (
        Option("steel", "Steel, as the rings", "The balls are of the material of the rings."),
        Option(
            "silicon nitride",
            "Silicon nitride (hybrid bearing)",
            "Ceramic balls in steel rings: stiffer contacts, and balls of less than half the mass. "
            "The load rating of steel balls does not apply to them.",
        ),
    ),
    first=True,
    in_lessons=False,
)

KIND = Choice(
    "kind",
    "Kind of bearing",
    "",
    tuple(Option(*variant) for kind in KINDS.values() for variant in kind.variants),
    first=True,
    in_lessons=False,
)

CHOICE_LIST: tuple[Choice, ...] = (
    KIND, RACE, ROW, EDGE, FLOOR, LAW, BALLS, DIRECTIONS, NUMBERS, MATERIAL,
)  # fmt: skip
"""All choices, in the order in which they are applied."""

OF_SCENE = tuple(choice for choice in CHOICE_LIST if choice.of == "scene")
OF_DEFECT = tuple(choice for choice in CHOICE_LIST if choice.of == "defect")


def floor_name(floor: object) -> str:
    """Name of the option of FLOOR for a defect's floor."""
    kinds = {RoughFloor: "rough", MeasuredFloor: "measured"}
    return next((name for kind, name in kinds.items() if isinstance(floor, kind)), "flat")


def chosen_of(scene: Scene, selected: int = 0) -> dict[str, str]:
    """Options of a scene and of its `selected` defect, by the names of the choices."""
    defect = defects_of(scene)[selected]
    return {
        **{choice.name: choice.name_of(defect) for choice in OF_DEFECT},
        FLOOR.name: floor_name(defect.floor),
        **{choice.name: choice.name_of(scene) for choice in OF_SCENE},
        DIRECTIONS.name: IN_PART if isinstance(scene.dofs, tuple) else scene.dofs or "auto",
        KIND.name: scene.bearing.kind.variant(scene.bearing),
        NUMBERS.name: "drawing" if scene.bearing.is_drawn else "direct",
        MATERIAL.name: scene.bearing.ball_material,
    }
