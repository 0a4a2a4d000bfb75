"""Conversion of a bearing to another kind with the same dimensions."""

from __future__ import annotations

import dataclasses
import math

from bearingcore.bearings._ball import BALL
from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.bearings._kinds import KINDS
from bearingcore.bearings._roller import ROLLER
from bearingcore.bearings._row import USUAL_DISTANCE
from bearingcore.bearings._self_aligning import ASSUMED_ANGLE, SELF_ALIGNING, USUAL_GROOVE
from bearingcore.bearings._tapered import PAIR_PREFIX, TAPERED, USUAL_ANGLE
from bearingcore.common import _checks as checks


def convert_bearing(bearing: Bearing, variant: str) -> Bearing:
    """Return a bearing with the same dimensions as another variant, out of `Kind.variants`.

    Dimensions that the bearing does not have get usual values.

    Raises
    ------
    ValueError
        for an unknown variant, or where no such bearing exists.
    """
    kinds = {offered.name: kind for kind in KINDS.values() for offered in kind.variants}
    checks.choice("variant", variant, tuple(kinds))
    if kinds[variant] is TAPERED:
        return _tapered_rollers(bearing, variant)
    if kinds[variant] is ROLLER:
        diameter, pitch = bearing.ball_diameter, bearing.pitch_diameter
        return bearing.cylindrical(
            bearing.n_balls, diameter, diameter, pitch, bearing.radial_clearance
        )
    if kinds[variant] is SELF_ALIGNING:
        return _self_aligning(bearing)
    return _single_row(bearing) if kinds[variant] is BALL else _pair_of_balls(bearing, variant)


def drawn(bearing: Bearing) -> Bearing:
    """Return one row of steel balls with the dimensions of a bearing, in usual grooves.

    If the bearing has an inner groove, the row has the same one.
    """
    ball = bearing.ball_diameter
    return bearing.from_drawing(
        bearing.n_balls,
        ball,
        bearing.pitch_diameter,
        bearing.groove_radius("inner") or USUAL_GROOVES["inner"] * ball,
        USUAL_GROOVES["outer"] * ball,
        contact_angle=bearing.contact_angle,
        diametral_clearance=2.0 * bearing.radial_clearance,
    )


def _single_row(bearing: Bearing) -> Bearing:
    return bearing.replace(rows=()) if bearing.kind.has_drawing else drawn(bearing)


def _pair_of_balls(bearing: Bearing, arrangement: str) -> Bearing:
    distance, preload = bearing.row_distance, bearing.preload
    pair = _single_row(bearing).paired(
        USUAL_DISTANCE * bearing.ball_diameter if distance is None else distance,
        arrangement,
        0.0 if arrangement == "tandem" or preload is None else preload,
    )
    if bearing.rows_are_alike or len(bearing.rows) != 2:
        return pair
    return pair.replace(
        rows=tuple(
            dataclasses.replace(new, **old.own)  # type: ignore[arg-type]  # its own numbers
            for new, old in zip(pair.rows, bearing.rows, strict=True)
        )
    )


def _self_aligning(bearing: Bearing) -> Bearing:
    ball = bearing.ball_diameter
    angle = bearing.contact_angle or ASSUMED_ANGLE
    return bearing.self_aligning(
        bearing.n_balls,
        ball,
        0.5 * bearing.pitch_diameter / math.cos(angle) + 0.5 * ball,
        bearing.groove_radius("inner") or USUAL_GROOVE * ball,
        angle,
        bearing.radial_clearance,
    )


def _tapered_rollers(bearing: Bearing, variant: str) -> Bearing:
    diameter, distance, preload = bearing.ball_diameter, bearing.row_distance, bearing.preload
    row = bearing.tapered(
        bearing.n_balls,
        diameter,
        bearing.roller_length or diameter,
        bearing.pitch_diameter,
        bearing.contact_angle or USUAL_ANGLE,
        bearing.radial_clearance,
    )
    if variant == TAPERED.name:
        return row
    distance = USUAL_DISTANCE * diameter if distance is None else distance
    return row.paired(distance, variant.removeprefix(PAIR_PREFIX), preload or 0.0)
