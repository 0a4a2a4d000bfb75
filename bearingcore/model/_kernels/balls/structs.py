"""Arguments of compiled functions of balls with mass: numbers of the balls, and work space."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.model._kernels.structs import Array, Contacts, Passage, Path, Rotor

INNER, OUTER = 0, 1


class Races(NamedTuple):
    """Numbers of each ball that are not in `Contacts`, each array (n,), or (2, n) by race.

    The first row belongs to the inner contact, the second to the outer contact.

    Attributes
    ----------
    factor : (2, n) [N/m^exponent]
    distance : (2, n) [m]
        A_i and A_e, whose sum is A0; 0 where the line of contact is fixed.
    damping : (2, n) [N·s/m]
    mass [kg], inverse_mass [1/kg], centrifugal [N], weight [N]
    """

    factor: Array
    distance: Array
    damping: Array
    mass: Array
    inverse_mass: Array
    centrifugal: Array
    weight: Array


class BallSystem(NamedTuple):
    """Rings and balls with mass, and the path over the defects of each race."""

    rotor: Rotor
    contacts: Contacts
    races: Races
    inner_path: Path
    outer_path: Path


class BallForces(NamedTuple):
    """Work space of the equations of motion; the inner race or ring comes first.

    Attributes
    ----------
    x, v : (2, 5) [m], [m/s]
        displacement and velocity of the rings.
    S, f : (2, 5) [N·s], [N]
        Σ c δ e; force of the contacts of each race, as it acts on the body outside of them.
    contact : (2, n, 4)
        δ [m] (0 if the contact is open, less if it would pull), er, ez, 1/A [1/m].
    ball : (2, n) [N]
        force on the balls, radial and axial.
    released, before : (2, n)
        True for contacts that are compressed and yet do not push, now and a step ago.
    """

    x: Array
    v: Array
    S: Array
    f: Array
    contact: Array
    ball: Array
    released: NDArray[np.bool_]
    before: NDArray[np.bool_]


class BallSteps(NamedTuple):
    """Work space of steps: `passage` has the drops into the outer race, `inner` into the inner one.

    forces is that of the equations of motion; k (4, size) the rates of the four stages; trial
    (size,) a state that is tried.
    """

    passage: Passage
    inner: Passage
    forces: BallForces
    k: Array
    trial: Array
