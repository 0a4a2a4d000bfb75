"""Masses, springs and dampers of the rotor and of its housing (Eqs. 22, 23)."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks


@dataclass(frozen=True)
class Support:
    """Two rigid bodies: the inner ring with the shaft, and the outer ring with the housing, which
    rests on springs and dampers to ground (Eqs. 22, 23).

    Masses [kg], stiffness [N/m] and damping [N·s/m] along x, y, z; about x and y (rx, ry)
    stiffness [N·m/rad], damping [N·m·s/rad] and moments of inertia [kg·m²]. What is None is not
    known: a motion that needs it is refused by name.
    """

    inner_mass: float
    outer_mass: float
    stiffness_x: float
    stiffness_y: float
    damping_x: float
    damping_y: float
    stiffness_z: float | None = None
    damping_z: float | None = None
    stiffness_rx: float | None = None
    stiffness_ry: float | None = None
    damping_rx: float | None = None
    damping_ry: float | None = None
    inner_inertia: float | None = None
    outer_inertia: float | None = None

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is None and field.default is None:
                continue
            if field.name.startswith("damping"):
                value = checks.real_number(field.name, value, at_least=0.0)
            else:
                value = checks.real_number(field.name, value, above=0.0)
            object.__setattr__(self, field.name, value)

    def _along(self, what: str, dofs: Iterable[str]) -> NDArray[np.float64]:
        values = []
        for dof in dofs:
            value = getattr(self, f"{what}_{dof}")
            if value is None:
                raise checks.refuse(
                    f"{what}_{dof}", None, f"a number, as {dof} is among the free directions"
                )
            values.append(value)
        return np.array(values)

    def stiffness(self, dofs: Iterable[str]) -> NDArray[np.float64]:
        """Stiffness to ground along `dofs` [N/m, N·m/rad]. ValueError where it is not known."""
        return self._along("stiffness", dofs)

    def damping(self, dofs: Iterable[str]) -> NDArray[np.float64]:
        """Damping to ground along `dofs` [N·s/m, N·m·s/rad]. ValueError where it is not known."""
        return self._along("damping", dofs)

    def inertias(self, dofs: Iterable[str]) -> NDArray[np.float64]:
        """`inertia` of both bodies, the inner one first: (2 len(dofs),)."""
        names = tuple(dofs)
        return np.concatenate([self.inertia(body, names) for body in ("inner", "outer")])

    def inertia(self, body: str, dofs: Iterable[str]) -> NDArray[np.float64]:
        """Mass [kg] or moment of inertia [kg·m²] of `body` ("inner", "outer") along `dofs`."""
        values = []
        for dof in dofs:
            name = f"{body}_inertia" if dof in ("rx", "ry") else f"{body}_mass"
            value = getattr(self, name)
            if value is None:
                raise checks.refuse(name, None, f"a number, as {dof} is among the free directions")
            values.append(value)
        return np.array(values)
