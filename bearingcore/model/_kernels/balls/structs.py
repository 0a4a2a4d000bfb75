"""Arguments of compiled functions of balls with mass: their numbers, and their work space."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.model._kernels.structs import Array, Contacts, Passage, Path, Rotor

INNER, OUTER = 0, 1


class Races(NamedTuple):
    """Numbers of each ball that are not in `Contacts`, each array (n,), or (2, n) by race.

    The first row is that of the inner, the second that of the outer contact.

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
    """All that moves where balls have mass; the way over defects of each race."""

    rotor: Rotor
    contacts: Contacts
    races: Races
    inner_path: Path
    outer_path: Path


class BallForces(NamedTuple):
    """Work space of the equations of motion; by race, the inner one first.

    Attributes
    ----------
    x, v : (2, 5) [m], [m/s]
        displacement and velocity of the rings.
    S, f : (2, 5) [N·s], [N]
        Σ c δ e; force of the contacts, on the outer ring and on the balls' outer side.
    contact : (2, n, 4)
        δ [m] (0 for what does not push), er, ez, 1/A [1/m].
    ball : (2, n) [N]
        force on the balls, radial and axial.
    released, before : (2, n)
        contacts that are compressed and yet do not push, now and a step ago.
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
    """Work space of steps: positions of the balls, with the drops into the outer race and into the
    inner one; the equations of motion's; rates of the four stages (4, size); the state tried.
    """

    passage: Passage
    inner: Passage
    forces: BallForces
    k: Array
    trial: Array
