"""Arguments of kernels: small structs of arrays and numbers.

Quantity                                          | Symbol            | Unit
------------------------------------------------- | ----------------- | --------
displacement of the inner ring, tilts times r_d   | q = (x, y, z, r_d θx, r_d θy) | m
loads on the inner ring, moments divided by r_d   | F                 | N
cosine and sine of a ball's angle φ_j             | c, s              |
cosine and sine of the unloaded contact angle α0  | ca, sa            |
drop of the ball's centre, its rate               | d, d_rate         | m, m/s
parts of the ball's displacement along and across the unloaded line of contact | m, w | m
direction of the contact, radial and axial        | er, ez            |
compression, load and stiffness of a contact      | δ, Q, k1 = ∂Q/∂δ  | m, N, N/m
load over loaded distance, Q/A                    | k2                | N/m
radial and axial displacement of the inner groove's centre at a ball | r, z | m

Tilts are kept as r_d θ and moments as M/r_d, so that all five components of q are lengths, all of F
are forces, and a single number measures a residual. r_d is the common lever of the bearing;
`Contacts.reach` and `Contacts.arm` are the lengths of each row over r_d.

Equation numbers are those of Petersen, Howard & Prime (2014).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Contacts(NamedTuple):
    """The contacts of all balls, each array (n,), row after row.

    Attributes
    ----------
    angle [rad]
        of the contact's ball from the first ball, at cage angle 0.
    relative_speed
        cage speed of the row over that of the bearing, equal for all contacts of a row: at cage
        angle φ a ball is at angle + relative_speed φ.
    arm
        axial place of the row's inner groove centres over r_d.
    reach
        radius of the circle of the row's inner groove centres over r_d.
    line_r, line_z
        unloaded line of contact, radial and axial: cos α0, sin α0.
    fixed
        True if no displacement turns the line of contact, as between straight races.
    distance [m]
        unloaded distance A0 of the groove curvature centres; 0 if the line is fixed.
    clearance [m]
        radial clearance r_L.
    offset [m]
        axial place of the inner groove's centre beyond A0 sin α0, by which rows are preloaded.
    room [m]
        greatest compression that the geometry of the contact allows; with a fixed line also the
        greatest displacement along the races.
    factor [N/m^exponent], exponent
        of the load-deflection law Q = K δ^exponent (Eq. 13); 3/2 for balls.
    rows : (k, 2)
        first contact and number of contacts of each row.
    most_tilt [m]
        greatest tilt for which the small-angle equations hold, times r_d.
    """

    angle: Array
    relative_speed: Array
    arm: Array
    reach: Array
    line_r: Array
    line_z: Array
    fixed: NDArray[np.bool_]
    distance: Array
    clearance: Array
    offset: Array
    room: Array
    factor: Array
    exponent: Array
    rows: Integers
    most_tilt: float

    def angles_at(self, cage_angles: Array) -> Array:
        """Return the angles (n, contacts) [rad] of all contacts at cage angles (n,) [rad]."""
        return cage_angles[:, None] * self.relative_speed + self.angle

    def gradients(self, angles: Array, radial: Array, axial: Array) -> Array:
        """Return the derivatives (..., contacts, 5) by q of a motion along (radial, axial).

        Contacts at angles (..., contacts) [rad] move by e·q: e = (er c, er s, ez, τ s, −τ c), with
        τ as in `contact.tilting`.
        """
        c, s = np.cos(angles), np.sin(angles)
        tilting = self.reach * axial - self.arm * radial
        along = np.broadcast_to(axial, c.shape)
        return np.stack([radial * c, radial * s, along, tilting * s, -tilting * c], axis=-1)

    def compression(self, load: float, contact: int = 0) -> float:
        """Return the compression [m] of a contact that carries a load [N]."""
        return float((load / self.factor[contact]) ** (1.0 / self.exponent[contact]))


class Path(NamedTuple):
    """The path of a ball's centre over all defects.

    Attributes
    ----------
    defects : (m, len(PATH_COLUMNS))
        see `codes.PATH_COLUMNS`.
    tables : (t,) [m]
        tabulated drops, one after the other.
    """

    defects: Array
    tables: Array


class Place(NamedTuple):
    """Places of the balls at one instant, each array (n,): cosine, sine and drop [m]."""

    c: Array
    s: Array
    d: Array


class Passage(NamedTuple):
    """Places of the balls and changing forces at some instants.

    Attributes
    ----------
    c, s, d [m], d_rate [m/s] : (instants, n)
        cosine, sine, drop and its rate.
    push : (instants, 5) [N]
        force on the inner ring from unbalance and from samples; moments divided by r_d.
    circle_c, circle_s : (n,)
        cosine and sine of each contact's angle from the first ball.
    """

    c: Array
    s: Array
    d: Array
    d_rate: Array
    push: Array
    circle_c: Array
    circle_s: Array


class StaticLoad(NamedTuple):
    """Loads (5,) [N], moments divided by r_d; numbers of the free directions, 0 to 4, rising."""

    force: Array
    active: Integers


class Descent(NamedTuple):
    """Work space of Newton's descent.

    Attributes
    ----------
    g : (2, 5) [N], H : (2, 5, 5) [N/m]
        gradient and Hessian at the displacement and at its trial.
    L : (5, 5), p : (5,) [m], trial : (5,) [m]
        Cholesky factor, step, and trial of the displacement.
    start : (5,) [m]
        displacement from which the descent with softened contacts begins.
    soft, firm : (contacts,) [N/m^exponent]
        factors of softened contacts, and of contacts that carry more than rounding (others 0).
    """

    g: Array
    H: Array
    L: Array
    p: Array
    trial: Array
    start: Array
    soft: Array
    firm: Array


class MapWork(NamedTuple):
    """Work space of a map.

    Attributes
    ----------
    descent
        a struct in itself, as each array costs time in every call that passes it on.
    state, guess : (5,) [m]
        the displacement, and a first guess of it.
    place, slope [m/rad]
        places of the balls, and slopes of their drops over the cage angle.
    circle_c, circle_s : (contacts,)
        cosine and sine of each contact's angle from the first ball.
    """

    descent: Descent
    state: Array
    guess: Array
    place: Place
    slope: Array
    circle_c: Array
    circle_s: Array


class MapPaths(NamedTuple):
    """Paths of the e rows of a map: defects (e, m, columns), of which counts (e,) are used; tables.

    leads (e, n) [rad]: angle by which turning defects are ahead, at each of n cage angles.
    """

    defects: Array
    counts: Integers
    tables: Array
    leads: Array


class MapMemory(NamedTuple):
    """The newest row of a map, from which the next row starts.

    Attributes
    ----------
    q : (n, 5) [m]
        states, tilts times r_d.
    drops : (n, contacts) [m], loads : (n, contacts) [N]
    evaluations : (n,)
        number of evaluations of the energy.
    """

    q: Array
    drops: Array
    loads: Array
    evaluations: Integers


class MapAnswers(NamedTuple):
    """Output arrays of a map of e rows and n cage angles.

    Attributes
    ----------
    stiffness : (15, e, n) [N/m]
        upper triangle, row by row; NaN where there is no equilibrium.
    loaded : (e, n)
    greatest : (e, n) [N]
        load of the most heavily loaded contact.
    status, residual : (e, n)
    """

    stiffness: Array
    loaded: Integers
    greatest: Array
    status: NDArray[np.int8]
    residual: Array


VELOCITIES, SMOOTH, PLANAR = 0, 1, 2
"""Variables of a motion: v; w; w of contacts that stay in the plane. See `motion.march`."""


class Rotor(NamedTuple):
    """Both bodies along the n active directions, each array (n,), and the manner of marching.

    Attributes
    ----------
    force [N], inverse_inner [1/kg], inverse_outer [1/kg], stiffness [N/m], damping [N·s/m]
        load and inverse mass of the inner ring, inverse mass and support of the outer one.
    active : (n,)
        numbers of the directions.
    cage_speed [rad/s]
        of the bearing; the cage of a row turns at `Contacts.relative_speed` times it.
    contact_damping [N·s/m]
        c of Eq. 18.
    variables
        the marched variables: `VELOCITIES`, `SMOOTH` or `PLANAR`.
    tension
        True if the damper may pull a ball back, as published.
    turning_force [N]
        force that turns with the shaft, along x at cage angle 0.
    shaft_ratio
        speed of the shaft over that of the cage.
    samples : (m, 5) [N]
        of a force on the inner ring, moments divided by r_d, the last one 0; m is 0 or at least 2.
    samples_a_radian [1/rad]
        number of samples per radian of the cage; the first one is at cage angle 0.
    """

    force: Array
    inverse_inner: Array
    inverse_outer: Array
    stiffness: Array
    damping: Array
    active: Integers
    cage_speed: float
    contact_damping: float
    variables: int
    tension: bool
    turning_force: float
    shaft_ratio: float
    samples: Array
    samples_a_radian: float


class System(NamedTuple):
    """The moving system: two bodies, the contacts between them, and the path over their defects."""

    rotor: Rotor
    contacts: Contacts
    path: Path


class Forces(NamedTuple):
    """Work space of the equations of motion.

    Attributes
    ----------
    x, v : (5,) [m], [m/s]
        displacement and velocity of the inner ring relative to the outer ring.
    f : (5,) [N], S : (5,) [m]
        force on the outer ring; Σ δ e.
    touching : (contacts,)
        numbers of the compressed contacts, in order.
    contact : (contacts, 4)
        their δ [m], er, ez, 1/A [1/m] (0 if a contact does not swivel, as its centres have passed
        each other).
    touched : (1,)
        number of compressed contacts.
    """

    x: Array
    v: Array
    f: Array
    S: Array
    touching: Integers
    contact: Array
    touched: Integers


class Slopes(NamedTuple):
    """Work space of the tangent.

    Attributes
    ----------
    Sx : (5, 5), Px : (5, 5) [N/m], Pv : (5, 5) [N·s/m]
        derivatives of Σ δ e and of the force by displacement (x) and velocity (v).
    e, t, e_turn, t_turn : (5,)
        directions along and across a contact in q, and their derivatives by the cage angle.
    rows : (2 n, 4 n)
        sums over directions, for all columns of the tangent.
    """

    Sx: Array
    Px: Array
    Pv: Array
    e: Array
    t: Array
    e_turn: Array
    t_turn: Array
    rows: Array


class Steps(NamedTuple):
    """Work space of steps, of the equations of motion and of the tangent.

    k (4, size) are the rates of the four stages, trial (size,) is a state that is tried.
    """

    passage: Passage
    forces: Forces
    slopes: Slopes
    k: Array
    trial: Array


class Recorded(NamedTuple):
    """Output of steps.

    Attributes
    ----------
    history : (samples, 6, n)
        displacement, velocity and acceleration of the inner ring, then of the outer one.
    places : (places, k, balls) [m]
        positions of balls with mass: radial, and axial unless the motion is planar.
    every
        number of samples from one row of places to the next.
    """

    history: Array
    places: Array
    every: int
