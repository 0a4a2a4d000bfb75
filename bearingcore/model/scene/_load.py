"""Static load on the inner ring (Eq. 2)."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from bearingcore.common import Array, _checks as checks


@dataclass(frozen=True)
class Load:
    """Static load on the inner ring (Eq. 2): forces [N] and moments [N·m]. A weight has fy < 0."""

    fx: float = 0.0
    fy: float = 0.0
    fz: float = 0.0
    mx: float = 0.0
    my: float = 0.0

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            checks.keep_number(self, field.name)

    @property
    def has_moment(self) -> bool:
        """True if the load has a moment."""
        return (self.mx, self.my) != (0.0, 0.0)

    @property
    def vector(self) -> Array:
        """(Fx, Fy, Fz, Mx, My), shape (5,) [N, N·m]."""
        return np.array([self.fx, self.fy, self.fz, self.mx, self.my])
