"""Angles of the balls, and their drop into defects (Eqs. 4 and 6)."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.model._kernels.codes import (
    BALL_RADIUS,
    CENTER,
    CHORD,
    DEPTH,
    EDGE,
    EVERY_ROW,
    EXACT,
    FLOOR_ANGLE,
    HALF_EXTENT,
    PUBLISHED,
    RACEWAY_RADIUS,
    ROW,
    TABLE,
    TABLE_SIZE,
    TABLE_START,
    TURN_RATIO,
)
from bearingcore.model._kernels.compiling import called, compiled, inlined
from bearingcore.model._kernels.structs import Passage

BLOCK = 256
"""Number of half steps whose ball positions are laid out at once; they fit into the cache."""


@called
def drop_and_slope(x, half_extent, depth, s_floor, edge, R, r_b):
    """Drop of a ball's centre [m] at the angle x [rad] from the defect's middle, and its slope.

    Written so that no two nearly equal numbers are subtracted: 1 − cos s = sin²s/(1 + cos s).

    s_floor [rad]    angle from the edge at which the ball reaches the floor
    R, r_b [m]       radii of the raceway and of the ball
    """
    s = half_extent - abs(x)  # angle from the nearer edge inwards
    if s < 0.0:
        return 0.0, 0.0
    if s >= s_floor:
        return depth, 0.0
    if edge in (PUBLISHED, CHORD):
        factor = 0.25 if edge == PUBLISHED else 1.0
        u = factor * R * R * s * s
        root = math.sqrt(max(r_b * r_b - u, 0.0))
        drop = u / (r_b + root)  # Equation (6): r_b − sqrt(r_b² − factor R² s²)
        steep = factor * R * R * s / root if root > 0.0 else 0.0
    else:
        sn = math.sin(s)
        cs = math.cos(s)
        root = math.sqrt(max(r_b * r_b - R * R * sn * sn, 0.0))
        sagitta = R * sn * sn / (1.0 + cs)
        sink = R * R * sn * sn / (r_b + root)
        lever = R * R * sn * cs / root if root > 0.0 else 0.0
        if edge == EXACT:  # R cos s − sqrt(r_b² − R² sin² s) − (R − r_b)
            drop = sink - sagitta
            steep = lever - R * sn
        else:  # (R + r_b) − (R cos s + sqrt(r_b² − R² sin² s))
            drop = sink + sagitta
            steep = lever + R * sn
    if drop >= depth:
        return depth, 0.0
    return drop, -steep if x > 0.0 else steep


@called
def path_drop(angle, cage_angle, lead, row, path):
    """Drop [m] of a ball of a row at `angle`, and its derivative by the cage angle [m/rad].

    `cage_angle` is the angle of the row's own cage. A defect turns by its `turn_ratio` times this
    angle. Defects that turn are a further angle `lead` ahead, because cage and shaft can be at any
    angle to each other. Defects of one race do not overlap here, because overlapping ones share a
    table. Drops into both races add.
    """
    defects = path.defects
    tables = path.tables
    total = 0.0
    total_slope = 0.0
    for i in range(defects.shape[0]):
        if defects[i, ROW] != EVERY_ROW and defects[i, ROW] != row:
            continue
        turn = defects[i, TURN_RATIO]
        half = defects[i, HALF_EXTENT]
        # angle from the defect's middle, from −π to π (Eq. 4)
        x = angle - defects[i, CENTER] - turn * cage_angle
        if turn != 0.0:
            x -= lead
        x -= 2.0 * math.pi * math.floor(x / (2.0 * math.pi) + 0.5)
        if abs(x) > half:
            continue
        if defects[i, EDGE] == TABLE:
            start = int(defects[i, TABLE_START])
            cells = int(defects[i, TABLE_SIZE]) - 1
            position = (x + half) / (2.0 * half) * cells
            k = min(int(position), cells - 1)
            rise = tables[start + k + 1] - tables[start + k]
            drop = tables[start + k] + (position - k) * rise
            slope = rise * cells / (2.0 * half)
        else:
            drop, slope = drop_and_slope(
                x,
                half,
                defects[i, DEPTH],
                defects[i, FLOOR_ANGLE],
                defects[i, EDGE],
                defects[i, RACEWAY_RADIUS],
                defects[i, BALL_RADIUS],
            )
        total += drop
        total_slope += slope * (1.0 - turn)  # dx per cage angle, as the ball turns with its cage
    return total, total_slope


def ball_path(ball_angles, cage_angles, row, path):
    """Drop (n,) [m] of a ball of a row at n angles, each with the cage angle of the same index."""
    drops = np.empty(ball_angles.size)
    fill_drops(ball_angles, cage_angles, row, path, drops)
    return drops


def drops_of(contacts, path, cage_angles, turned):
    """Drop (n, balls) [m] of each ball on a path at cage angles (n,) [rad], row after row.

    turned (n,) [rad]: cage angles that give the turn of the defects, unlike `cage_angles` where the
    shaft leads its cage.
    """
    angles, drops = contacts.angles_at(cage_angles), []
    for row, (first, count) in enumerate(contacts.rows.tolist()):
        phi = angles[:, first : first + count]
        cage = np.broadcast_to((contacts.relative_speed[first] * turned)[:, None], phi.shape)
        drops.append(ball_path(phi.ravel(), cage.ravel(), row, path).reshape(phi.shape))
    return np.concatenate(drops, axis=1)


@compiled
def fill_drops(ball_angles, cage_angles, row, path, drops):
    """Compiled body of `ball_path`."""
    for i in range(ball_angles.size):
        drops[i], _ = path_drop(ball_angles[i], cage_angles[i], 0.0, row, path)


def roll_over(surface, circle):
    """Depth (n,) to which a ball sinks over a surface: min over j of surface[j] + circle[|i − j|].

    circle[k] is how far the ball hangs below a point that it touches k nodes away. It rises and is
    convex, so the touched point never moves back while the ball moves on. The touched point of the
    middle node therefore bounds those on either side: halving finds all in n log n steps.
    """
    path = np.empty(surface.size)
    fill_depths(surface, circle, np.empty((128, 4), dtype=np.int64), path)
    return path


@compiled
def fill_depths(surface, circle, waiting, path):
    """Compiled body of `roll_over`; `waiting` is its stack, see `push_nodes`."""
    reach = circle.size - 1
    push_nodes(waiting, 0, 0, surface.size - 1, 0, surface.size - 1)
    size = 1
    while size > 0:
        size -= 1
        first = waiting[size, 0]
        last = waiting[size, 1]
        low = waiting[size, 2]
        high = waiting[size, 3]
        i = (first + last) // 2
        least = math.inf
        touched = low
        for j in range(max(low, i - reach), min(high, i + reach) + 1):
            depth = surface[j] + circle[abs(i - j)]
            if depth < least:
                least = depth
                touched = j
        path[i] = least
        if first < i:
            push_nodes(waiting, size, first, i - 1, low, touched)
            size += 1
        if i < last:
            push_nodes(waiting, size, i + 1, last, touched, high)
            size += 1


@inlined
def push_nodes(waiting, size, first, last, low, high):
    """Push the nodes first to last, whose touched points are from low to high, onto `waiting`."""
    waiting[size, 0] = first
    waiting[size, 1] = last
    waiting[size, 2] = low
    waiting[size, 3] = high


@inlined
def place_balls(cage, contacts, circle_c, circle_s, c, s):
    """Write cosine and sine of each ball's angle into c and s (n,), at a cage angle [rad]."""
    rows = contacts.rows
    for row in range(rows.shape[0]):
        first = rows[row, 0]
        turned = contacts.relative_speed[first] * cage
        last = first + rows[row, 1]
        turn_balls(math.cos(turned), math.sin(turned), circle_c, circle_s, c, s, first, last)


@inlined
def turn_balls(cage_c, cage_s, circle_c, circle_s, c, s, first, last):
    """Write cosine and sine of a row's balls into c and s (n,); cage_c and cage_s are its cage's.

    A rotation is cheaper than a sine and a cosine for each ball.
    """
    for j in range(first, last):
        c[j] = cage_c * circle_c[j] - cage_s * circle_s[j]
        s[j] = cage_s * circle_c[j] + cage_c * circle_s[j]


@inlined
def drops_of_balls(cage, lead, contacts, path, d, slope):
    """Write the drop [m] of every ball into d, its derivative by the cage angle into slope [m/rad].

    Only balls at a defect are computed: from the first one after the defect's beginning to the
    last one before its end. Defects that turn are an angle `lead` [rad] ahead, see `path_drop`.
    """
    defects = path.defects
    rows = contacts.rows
    for j in range(d.size):
        d[j] = 0.0
        slope[j] = 0.0
    for k in range(defects.shape[0]):
        half = defects[k, HALF_EXTENT]
        turn = defects[k, TURN_RATIO]
        for row in range(rows.shape[0]):
            if defects[k, ROW] != EVERY_ROW and defects[k, ROW] != row:
                continue
            first = rows[row, 0]
            n = rows[row, 1]
            spacing = 2.0 * math.pi / n
            speed = contacts.relative_speed[first]
            turned = speed * cage
            start = turned + contacts.angle[first]
            ahead = lead if turn != 0.0 else 0.0
            begin = (defects[k, CENTER] + turn * turned + ahead - half - start) / spacing
            ball = math.ceil(begin - 1e-9)
            # a defect all around must not meet a ball twice
            end = min(begin + 2.0 * half / spacing + 1e-9, ball + n - 0.5)
            while ball <= end:
                j = first + int(ball) % n
                d[j], rise = path_drop(start + spacing * ball, turned, lead, row, path)
                slope[j] = speed * rise
                ball += 1.0


@called
def lay_out_drops(cage, lead, contacts, path, d, slope):
    """`drops_of_balls` as a function that is called, not inlined."""
    drops_of_balls(cage, lead, contacts, path, d, slope)


def new_passage(instants, angle):
    """Return an empty `Passage`; its contacts are at angles (n,) [rad] from the first ball."""
    c, s, d, d_rate = np.zeros((4, instants, angle.size))
    return Passage(c, s, d, d_rate, np.zeros((instants, 5)), np.cos(angle), np.sin(angle))


@called
def lay_out_forces(start, turn, count, rotor, passage):
    """Write the forces of unbalance and samples at `count` cage angles start + i·turn [rad]."""
    samples = rotor.samples
    if rotor.turning_force == 0.0 and samples.shape[0] == 0:
        return
    push = passage.push
    for i in range(count):
        shaft = rotor.shaft_ratio * (start + i * turn)
        push[i, 0] = rotor.turning_force * math.cos(shaft)
        push[i, 1] = rotor.turning_force * math.sin(shaft)
        if samples.shape[0] == 0:
            continue
        place = (start + i * turn) * rotor.samples_a_radian
        k = min(int(place), samples.shape[0] - 2)
        part = min(place - k, 1.0)
        for a in range(5):
            pushed = samples[k, a] + part * (samples[k + 1, a] - samples[k, a])
            push[i, a] = pushed + (push[i, a] if a < 2 else 0.0)


@called
def lay_out_balls(start, turn, count, cage_speed, contacts, path, passage):
    """Write the balls' places at `count` cage angles start + i·turn [rad] into a passage.

    Each cage is turned by recurrence, and each ball is at a fixed angle to its cage.
    """
    rows = contacts.rows
    for row in range(rows.shape[0]):
        first = rows[row, 0]
        last = first + rows[row, 1]
        speed = contacts.relative_speed[first]
        turn_c = math.cos(speed * turn)
        turn_s = math.sin(speed * turn)
        cage_c = math.cos(speed * start)
        cage_s = math.sin(speed * start)
        for i in range(count):
            c = passage.c[i]
            s = passage.s[i]
            turn_balls(cage_c, cage_s, passage.circle_c, passage.circle_s, c, s, first, last)
            cage_c, cage_s = cage_c * turn_c - cage_s * turn_s, cage_s * turn_c + cage_c * turn_s
    if path.defects.shape[0] == 0:
        return
    lay_out_drops_and_rates(start, turn, count, cage_speed, contacts, path, passage)


@inlined
def lay_out_drops_and_rates(start, turn, count, cage_speed, contacts, path, passage):
    """Write drops and their rates at `count` cage angles into a passage."""
    for i in range(count):
        rate = passage.d_rate[i]
        drops_of_balls(start + i * turn, 0.0, contacts, path, passage.d[i], rate)
        for j in range(rate.size):
            rate[j] *= cage_speed
