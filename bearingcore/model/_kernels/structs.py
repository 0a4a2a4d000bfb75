"""Arguments of kernels: small structs of arrays and numbers.

Quantity                                          | Symbol            | Unit
------------------------------------------------- | ----------------- | --------
displacement of the inner ring, tilts times r_d   | q = (x, y, z, r_d θx, r_d θy) | m
loads on the inner ring, moments over r_d         | F                 | N
cosine and sine of a ball's angle φ_j             | c, s              |
cosine and sine of the unloaded contact angle α0  | ca, sa            |
drop of the ball's centre, its rate               | d, d_rate         | m, m/s
parts of the ball's displacement along and across the unloaded line of contact | m, w | m
direction of the contact, radial and axial        | er, ez            |
compression, load and stiffness of a contact      | δ, Q, k1 = ∂Q/∂δ  | m, N, N/m
load over loaded distance, Q/A                    | k2                | N/m
radial and axial displacement of the inner groove's centre at a ball | r, z | m

Tilts are carried as r_d θ and moments as M/r_d, so that all five components of q are lengths, all
of F are forces, and one number measures a residual. r_d is the common lever of the bearing; where
rows differ, `Contacts.reach` and `Contacts.arm` relate their own lengths to it.

Equation numbers are those of Petersen, Howard & Prime (2014).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Contacts(NamedTuple):
    """The contacts of all balls of all rows, each array (n,); those of a row follow each other.

    Attributes
    ----------
    angle [rad]
        from the first ball to the contact's, at cage angle 0.
    relative_speed
        cage speed of the row over that of the bearing: at cage angle φ a ball is at
        angle + relative_speed φ. The same for all of a row.
    arm
        axial place of the row's inner groove centres over r_d.
    reach
        radius on which the inner groove's centres of the row are, over r_d.
    line_r, line_z
        unloaded line of contact, radial and axial: cos α0, sin α0.
    fixed
        True where no displacement turns the line of contact, as between straight races.
    distance [m]
        unloaded distance A0 of the groove curvature centres, about which a line turns that is not
        fixed; 0 of one that is.
    clearance [m]
        radial clearance r_L.
    offset [m]
        axial place of the inner groove's centre beyond A0 sin α0: how rows are preloaded.
    room [m]
        greatest compression, and where the line is fixed the greatest displacement along the
        races, that the geometry of the contact allows.
    factor [N/m^exponent], exponent
        of the load-deflection law Q = K δ^exponent (Eq. 13): 3/2 for balls.
    rows : (k, 2)
        first contact of each row and how many it has.
    most_tilt [m]
        greatest rotation that is small, over which nothing here holds, times r_d.
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
        """Angles (n, contacts) [rad] of all contacts at cage angles (n,) [rad]."""
        return cage_angles[:, None] * self.relative_speed + self.angle

    def gradients(self, angles: Array, radial: Array, axial: Array) -> Array:
        """Derivatives (..., contacts, 5) by q of a motion along (radial, axial) at the contacts.

        Contacts at angles (..., contacts) [rad] move by e·q: e = (er c, er s, ez, τ s, −τ c), with
        τ as in `contact.tilting`.
        """
        c, s = np.cos(angles), np.sin(angles)
        tilting = self.reach * axial - self.arm * radial
        along = np.broadcast_to(axial, c.shape)
        return np.stack([radial * c, radial * s, along, tilting * s, -tilting * c], axis=-1)

    def compression(self, load: float, contact: int = 0) -> float:
        """Compression [m] of a contact that carries a load [N]."""
        return float((load / self.factor[contact]) ** (1.0 / self.exponent[contact]))


class Path(NamedTuple):
    """The way of a ball's centre over all defects.

    Attributes
    ----------
    defects : (m, len(PATH_COLUMNS))
        see `path.PATH_COLUMNS`.
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
    """Places of the balls at some instants, and the changing forces.

    Attributes
    ----------
    c, s, d [m], d_rate [m/s] : (instants, n)
        cosine, sine, drop and its rate.
    push : (instants, 5) [N]
        on the inner ring, from unbalance and from samples; moments over r_d.
    circle_c, circle_s : (n,)
        cosine and sine of the angle from the first ball.
    """

    c: Array
    s: Array
    d: Array
    d_rate: Array
    push: Array
    circle_c: Array
    circle_s: Array


class StaticLoad(NamedTuple):
    """Loads (5,) [N], moments over r_d, and the free directions, rising numbers out of 0 to 4."""

    force: Array
    active: Integers


class Descent(NamedTuple):
    """Work space of Newton's descent.

    Attributes
    ----------
    g : (2, 5) [N], H : (2, 5, 5) [N/m]
        gradient and Hessian at the ring's place and at the place that is tried.
    L : (5, 5), p : (5,) [m], trial : (5,) [m]
        Cholesky factor, step, and the displacement tried.
    start : (5,) [m]
        where the descent with softened contacts begins.
    soft, firm : (contacts,) [N/m^exponent]
        factors of softened contacts, and of those that carry more than rounding.
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
        apart, as each array costs time in every call that hands it on.
    state, guess : (5,) [m]
        the displacement that moves, and one to begin with.
    place, slope [m/rad]
        places of the balls, and slopes of their drops over the cage angle.
    circle_c, circle_s : (contacts,)
        cosine and sine of the angle from the first ball.
    """

    descent: Descent
    state: Array
    guess: Array
    place: Place
    slope: Array
    circle_c: Array
    circle_s: Array


class MapPaths(NamedTuple):
    """Paths of the e rows of a map: defects (e, m, columns), counts (e,) of them used; tables.

    leads (e, n) [rad]: how far defects that turn are ahead, at each of n cage angles.
    """

    defects: Array
    counts: Integers
    tables: Array
    leads: Array


class MapMemory(NamedTuple):
    """The newest row of a map, from which the next goes on.

    Attributes
    ----------
    q : (n, 5) [m]
        states, tilts times r_d.
    drops : (n, contacts) [m], loads : (n, contacts) [N]
    evaluations : (n,)
        how often the energy was evaluated.
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
        load of the contact that carries most.
    status, residual : (e, n)
    """

    stiffness: Array
    loaded: Integers
    greatest: Array
    status: NDArray[np.int8]
    residual: Array


VELOCITIES, SMOOTH, PLANAR = 0, 1, 2
"""Variables of a motion: v as it is; w; w where contacts stay in the plane. See `motion`."""


class Rotor(NamedTuple):
    """Both bodies along the n active directions, each array (n,), and how their motion is marched.

    Attributes
    ----------
    force [N], inverse_inner [1/kg], inverse_outer [1/kg], stiffness [N/m], damping [N·s/m]
        load and inverse mass of the inner ring, inverse mass and support of the outer one.
    active : (n,)
        numbers of the directions.
    cage_speed [rad/s]
        of the bearing; that of a row is `Contacts.relative_speed` times it.
    contact_damping [N·s/m]
        c of Eq. 18.
    variables
        `VELOCITIES`, `SMOOTH` or `PLANAR`: what is marched.
    tension
        whether the damper may draw a ball back, as published.
    turning_force [N]
        force that turns with the shaft, along x at cage angle 0.
    shaft_ratio
        speed of the shaft over that of the cage.
    samples : (m, 5) [N]
        of a force on the inner ring, moments over r_d, the last one 0; none, or two and more.
    samples_a_radian [1/rad]
        samples while the cage turns by one radian, the first one at cage angle 0.
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
    """All that moves: two bodies, the contacts between them, and the way over their defects."""

    rotor: Rotor
    contacts: Contacts
    path: Path


class Forces(NamedTuple):
    """Work space of the equations of motion.

    Attributes
    ----------
    x, v : (5,) [m], [m/s]
        inner against outer ring.
    f : (5,) [N], S : (5,) [m]
        force on the outer ring; Σ δ e.
    touching : (contacts,)
        numbers of the compressed contacts, in order.
    contact : (contacts, 4)
        their δ [m], er, ez, 1/A [1/m] (0 where the centres have passed each other and a contact
        does not swivel).
    touched : (1,)
        how many are compressed.
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
        how Σ δ e and the force change with displacement and velocity.
    e, t, e_turn, t_turn : (5,)
        along and across a contact in q, and their derivatives with the cage's turning.
    rows : (2 n, 4 n)
        sums over directions, of all columns.
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
    """Work space of steps: ball positions, the equations of motion's, the tangent's, rates of the
    four stages (4, size), and the state tried (size,).
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
        of balls with mass: radial, and axial unless the motion is planar.
    every
        samples from place to place.
    """

    history: Array
    places: Array
    every: int
