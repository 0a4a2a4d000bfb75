"""Numbers of a bearing of any kind, before its kind says what follows from them."""

from __future__ import annotations

from dataclasses import dataclass, field

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._kinematics import Kinematics
from bearingcore.bearings._material import STEEL_DENSITY
from bearingcore.bearings._row import MOST_ROWS, Row
from bearingcore.common import _checks as checks, _scene_file as scene_file

ESTIMATES = ("n_balls", "ball_diameter", "pitch_diameter", "roller_length")
"""Fields that may be estimates."""

_ABOVE_0 = (
    *("groove_center_radius", "load_deflection_factor"),
    *("outer_raceway_radius", "inner_raceway_radius"),
)


@dataclass(frozen=True)
class Numbers(Kinematics):
    """Fields of a bearing, each checked by itself; `Bearing` says what they are."""

    groove_center_radius: float
    groove_center_distance: float | None
    radial_clearance: float
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float
    inner_groove_radius: float | None = None
    outer_groove_radius: float | None = None
    youngs_modulus: float | None = None
    poisson: float | None = None
    rows: tuple[Row, ...] = ()
    roller_length: float | None = None
    density: float = field(default=STEEL_DENSITY, metadata=scene_file.LEFT_OUT)
    kind: object = ""  # of `Bearing` a Kind, whose methods take these numbers
    estimated: tuple[str, ...] = field(default=(), metadata=scene_file.LEFT_OUT)
    ball_youngs_modulus: float | None = None
    ball_poisson: float | None = None
    dynamic_load_rating: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in _ABOVE_0:
            checks.keep_number(self, name, above=0.0)
        for name in ("groove_center_distance", "roller_length"):
            checks.keep_number(self, name, optional=True, above=0.0)
        checks.keep_number(self, "density", above=0.0, unit="kg/m³")
        checks.keep_number(self, "dynamic_load_rating", optional=True, above=0.0, unit="N")
        least = -self.ball_radius  # more than any contact could be compressed
        checks.keep_number(self, "radial_clearance", at_least=least, unit="m")
        drawing.check_fit(vars(self))
        checks.keep(self, **drawing.checked(vars(self)))
        rows = self.rows if isinstance(self.rows, tuple | list) else (self.rows,)
        checks.keep(self, rows=tuple(rows))
        if len(self.rows) > MOST_ROWS or not all(isinstance(row, Row) for row in self.rows):
            raise checks.refuse("rows", self.rows, f"at most {MOST_ROWS} of Row")
        names: object = self.estimated
        for name in names if isinstance(names, tuple | list) else (names,):
            checks.choice("estimated", name, ESTIMATES)
        checks.keep(self, estimated=tuple(self.estimated))

    @property
    def is_hybrid(self) -> bool:
        """True where the balls are of another material than the rings."""
        balls = (self.ball_youngs_modulus, self.ball_poisson)
        rings = (self.youngs_modulus, self.poisson)
        return any(ball not in (None, ring) for ball, ring in zip(balls, rings, strict=True))

    @property
    def is_drawn(self) -> bool:
        """True where the bearing carries its groove radii and material."""
        return any(getattr(self, name) is not None for name in drawing.OPTIONAL_FIELDS)
