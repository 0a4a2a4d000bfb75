"""Masses, springs and dampers of the rotor and the housing (Eqs. 22, 23)."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearingcore.common import Array, _checks as checks

BODIES = ("inner", "outer")


@dataclass(frozen=True)
class Support:
    """Masses, springs and dampers of inner ring with shaft and outer ring with housing.

    Both are rigid bodies; the housing rests on springs and dampers to ground (Eqs. 22, 23).

    Masses [kg], stiffness [N/m] and damping [N·s/m] along x, y, z; about x and y (rx, ry)
    stiffness [N·m/rad], damping [N·m·s/rad] and moments of inertia [kg·m²]. None means
    not known: a motion that needs the number is refused, and the error names it.
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
            least: dict[str, Any] = {
                "at_least" if field.name.startswith("damping") else "above": 0.0
            }
            checks.keep_number(self, field.name, optional=field.default is None, **least)

    def _numbers(self, names: Mapping[str, str]) -> Array:
        """Return numbers by direction; if one is unknown, refuse and name all unknown ones."""
        for dof, name in names.items():
            if getattr(self, name) is None:
                words = f"a number, as {dof} is among the free directions{self._remedy(names)}"
                raise checks.refuse(name, None, words)
        return np.array([getattr(self, name) for name in names.values()])

    def _remedy(self, dofs: Iterable[str]) -> str:
        """Words: all numbers that motion along `dofs` lacks, and the way to do without them."""
        needed = {
            dof: [f"stiffness_{dof}", f"damping_{dof}", *(f"{b}_{_inertia(dof)}" for b in BODIES)]
            for dof in dofs
        }
        missing = {
            dof: [n for n in names if getattr(self, n) is None] for dof, names in needed.items()
        }
        needed_names = dict.fromkeys(name for names in missing.values() for name in names)
        known = tuple(dof for dof, names in missing.items() if not names)
        held = f", or scene.replace(dofs={known}) to hold the others" if known else ""
        return f". Give {', '.join(needed_names)} of the support{held}"

    def stiffness(self, dofs: Iterable[str]) -> Array:
        """Return the stiffness to ground along `dofs` [N/m, N·m/rad]; ValueError if unknown."""
        return self._numbers({dof: f"stiffness_{dof}" for dof in dofs})

    def damping(self, dofs: Iterable[str]) -> Array:
        """Return the damping to ground along `dofs` [N·s/m, N·m·s/rad]; ValueError if unknown."""
        return self._numbers({dof: f"damping_{dof}" for dof in dofs})

    def inertias(self, dofs: Iterable[str]) -> Array:
        """Return the `inertia` of both bodies, the inner one first: (2 len(dofs),)."""
        names = tuple(dofs)
        return np.concatenate([self.inertia(body, names) for body in BODIES])

    def inertia(self, body: str, dofs: Iterable[str]) -> Array:
        """Return mass [kg] or moment of inertia [kg·m²] of `body`, "inner" or "outer"."""
        return self._numbers({dof: f"{body}_{_inertia(dof)}" for dof in dofs})


def _inertia(dof: str) -> str:
    return "inertia" if dof in ("rx", "ry") else "mass"
