"""The sentences of a diagnosis."""

from __future__ import annotations

from collections.abc import Sequence

from bearingcore.common.numbers import thousands
from bearingcore.diagnosis.part.evidence import OtherLines, PartEvidence


def dropped(share: float) -> str:
    """Nothing to hear."""
    return (
        f"Cannot tell: {share:.0%} of the signal is one and the same number, as if the sensor had "
        "dropped out."
    )


def too_short(duration: float, passes: float, fewest: int) -> str:
    """Too few knocks."""
    return (
        f"Cannot tell: {duration:.3g} s hold {passes:.0f} ball passes, and no fewer than {fewest} "
        "tell anything."
    )


def too_many(samples: int, most: int) -> str:
    """More to listen to than may be."""
    return (
        f"Cannot tell: too many samples: {thousands(samples)}, allowed are most_samples = "
        f"{thousands(most)}."
    )


def too_slow(rate: float, needed: float) -> str:
    """Sampled too slowly."""
    return (
        f"Cannot tell: sampled at {rate:.0f} Hz, the signal does not reach high enough to show how "
        f"knocks repeat at this speed; {needed:.0f} Hz or more are needed."
    )


def damaged(own: PartEvidence) -> str:
    """A part is named."""
    shown = int((own.harmonics > own.noise).sum())
    return (
        f"Damage on the {own.part}: knocks repeat {own.frequency:.1f} times a second "
        f"({own.order:.3f} a turn, {own.slip:+.1%} against the geometry), {own.level:.0f} dB above "
        f"what surrounds them, {shown} of {len(own.harmonics)} harmonics clear, heard best from "
        f"{own.band.low / 1000:.1f} to {own.band.high / 1000:.1f} kHz."
    )


def alike(own: PartEvidence, part: str, level: float) -> str:
    """The lines of two parts are seen."""
    return (
        f"Cannot tell: something knocks, but the lines of {own.part} ({own.level:.0f} dB) and "
        f"{part} ({level:.0f} dB) are too much alike."
    )


def no_stronger(own: PartEvidence, other: OtherLines) -> str:
    """Lines that are none of this bearing's stand as high."""
    return (
        f"Cannot tell: the lines of the {own.part} ({own.level:.0f} dB) are no stronger than "
        f"others that repeat {other.order:.2f} times a turn ({other.level:.0f} "
        "dB), which are none of this bearing's. Check its geometry and speed."
    )


def no_sidebands(own: PartEvidence) -> str:
    """The part turns, and its lines do not show it."""
    return (
        f"Cannot tell: lines lie where the {own.part} would have them ({own.level:.0f} dB), but "
        f"without the sidebands of the {own.sideband_source} that it makes as it turns through the "
        "load. Check the bearing's geometry."
    )


def unexplained(other: OtherLines) -> str:
    """Something else knocks."""
    return (
        f"Cannot tell: something repeats {other.order:.2f} times a turn ({other.frequency:.1f} Hz, "
        f"{other.level:.0f} dB above what surrounds it), which is no line of this bearing. Check "
        "its geometry and speed, or look for another source."
    )


def nothing_but(why: str, share: float) -> str:
    """Nothing seen, and it means nothing."""
    return f"Cannot tell: no damage shows, but {why} ({share:.0%}), which may hide it."


def blows(kurtosis: float, duration: float) -> str:
    """Knocks that do not repeat as a part's do."""
    return (
        f"Cannot tell: the signal knocks (kurtosis {kurtosis:.1f}, where smooth running has 2), "
        f"but in {duration:.3g} s not at the rate of any part of this bearing. Blows from "
        "elsewhere and wide-spread wear do that. Measure again, longer."
    )


def weak(detectable: float, duration: float) -> str:
    """Nothing seen, but nothing would have been."""
    return (
        f"Cannot tell: no damage shows, but in {duration:.3g} s it would only if it made the "
        f"envelope swing by {detectable:.0%} or more. A longer recording tells more."
    )


def healthy(detectable: float) -> str:
    """None seen."""
    return (
        "No damage seen on outer race, inner race or balls: their lines do not stand out, and "
        f"knocks that make the envelope swing by {detectable:.0%} would have been seen."
    )


def faint(own: PartEvidence) -> str:
    """Lines too faint to name a part."""
    return (
        f"Cannot tell: faint lines lie where damage on the {own.part} would have them "
        f"({own.frequency:.1f} Hz, {own.level:.0f} dB above what surrounds them; noise reaches "
        f"{own.noise:.0f} dB). Measure again, longer or nearer to the bearing."
    )


def which_speed(frequency: float, readings: Sequence[tuple[str, float]]) -> str:
    """Knocks, but the speed decides whose they are."""
    ways = " or ".join(f"the {part} at {60.0 * speed:.0f}" for part, speed in readings)
    return (
        f"Cannot tell: knocks repeat {frequency:.1f} times a second, which may be {ways} turns a "
        "minute. Tell the shaft speed."
    )


def speed(shaft: float | None, source: str) -> str:
    """On what speed it rests."""
    if shaft is None:
        return f" No shaft speed is known ({source})."
    return f" Shaft speed {60.0 * shaft:.0f} turns a minute ({source})."
