"""The sentence on the effect of the last change, from the numbers of two chains alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearing_explorer.explorer.results.chain import Chain, Peak, have_same_order
from bearing_explorer.explorer.results.reasons import why_softer
from bearing_explorer.kit.plots import style
from bearingcore.model.statics import TERM_SYMBOLS
from bearingcore.model.sweeps import mode_symbol

LEAST = 0.01
"""Least relative change of a number that counts as a change."""
LEAST_TURN = math.radians(1.0)
"""Least mean angle [rad] by which loads must move to count as moved."""
LEAST_LOAD = 0.05
"""Least relative change of the greatest ball load that counts as a change."""
LEAST_LEVEL = 2.0
"""Least change of the loudest line [dB] that counts as a change."""
ALMOST_NONE = 30.0
"""Fall of a level [dB] after which hardly any vibration is left."""
_SAME = 1e-7  # relative rounding error
# greatest ln(f/f') of a mode: 0.75 ln(k/k') + 0.15. A root would give 0.5; masses may change too
_OF_STIFFNESS, _SHIFT = 0.75, 0.15
_SECOND = 1.5  # a second stiffness is named if it changes this many times as much as the first


@dataclass(frozen=True)
class Cause:
    """A change between two scenes.

    Parameters
    ----------
    words
        the change in words.
    defect, masses
        True if only defects were changed; True if rotor or support were changed.
    contacts
        True if the contacts themselves were changed: loads alone do not explain the stiffness then.
    why_not
        reason for loads that stay exactly as they are.
    play
        effect of contact angle and clearance on the play of the bearing, in words.
    weighs
        changed masses that `words` does not name, as the reason for a frequency that moves.
    """

    words: str
    defect: bool = False
    masses: bool = False
    contacts: bool = False
    why_not: str = ""
    play: str = ""
    weighs: str = ""


def story(by: Cause, now: Chain, before: Chain) -> str:
    """Name the cause, then its effects in order: load, stiffness, frequency, spectrum.

    "So" and "therefore" are used only where one effect causes the next.
    """
    if now.answered == 0.0:
        gone = "there is no equilibrium" + (" any more" if before.answered else ", as before")
        return f"{by.words or 'With the defect'}: {gone} ({now.reason})."
    if before.answered == 0.0:
        return f"{by.words or 'With the defect'}: now there is an equilibrium."
    along = direction(now, before)
    terms = named_terms(now, before, along)
    stiff = [f"k_{TERM_SYMBOLS[term][2:]} {_growth(_change(now, before, term))}" for term in terms]
    text = _load_and_stiffness(by, now, before, along, stiff)
    text = _add_band_and_peak(text, by, now, before, along, stiff)
    if before.silent and not now.silent:
        text += f"{'; ' if text else ''}now there is a spectrum"
    text = text or unchanged(now, before, by.why_not)
    text = f"{by.words}: {text}" if by.words else text[0].upper() + text[1:]
    if now.answered < 1.0:
        text += (
            f"; at {style.number(100.0 * (1.0 - now.answered), 2)} % of the cage angles there is "
            f"no equilibrium ({now.reason})"
        )
    if now.silent:
        text += f"; there is no spectrum: {now.silent}"
    return f"{text}."


def _load_and_stiffness(by: Cause, now: Chain, before: Chain, along: str, stiff: list[str]) -> str:
    """Say which balls carry the load now, and how that changed the stiffness."""
    moved = moved_load(now, before, by.defect)
    # changed contacts are a sufficient reason, and the cause has named them
    why = why_stiffer(now, before, along) if stiff and not by.contacts else ""
    # a move of the load explains the stiffness only if it changes where balls push back
    text = moved if "push" in why and moved else why
    if not why and not (stiff and by.contacts):
        text = moved or greatest_load_words(now, before)
    if by.play:
        text = f"{by.play}, {why}" if why else by.play
    if stiff:
        text += f"{', so ' if why or by.play else ', ' if text else ''}{style.list_words(stiff)}"
    return text


def _add_band_and_peak(
    text: str, by: Cause, now: Chain, before: Chain, along: str, stiff: list[str]
) -> str:
    """Add the changes of a natural frequency and of the spectrum's highest peak to `text`."""
    label = moved_band(now, before, along)
    peaks = (along, *(dof for dof in now.peaks if dof != along))
    peak = next(filter(None, (peak_words(now, before, dof, label) for dof in peaks)), "")
    band = band_words(label, now.bands[label], before.bands[label]) if label else ""
    if band and by.weighs:
        band += f" ({by.weighs})"
    last = [words for words in (band, peak) if words]
    if text and last:
        # a frequency follows from the stiffness along it, "x1" from k_xx, unless masses changed
        term = label and f"k_{label[:-1] * 2}"
        named = term and any(term in words for words in stiff)
        follows = named and band_follows(now, before, label)
        text += ". Therefore " if band and follows and not by.masses else "; "
    return text + (" and " if "with it" in peak else "; ").join(last)


def direction(now: Chain, before: Chain) -> str:
    """The direction of the sentence: that in which the housing is loudest.

    If nothing changes along it, the direction whose stiffness changes most; if no stiffness
    changes, one with a band that moves.
    """
    loudest = now.loudest
    if loudest and (
        abs(_change(now, before, f"k_{loudest}{loudest}")) >= LEAST
        or moved_band(now, before, loudest)
    ):
        return loudest
    terms = [term for term in now.stiffness if abs(_change(now, before, term)) >= LEAST]
    most = max(terms, key=lambda term: abs(_change(now, before, term)), default="")
    if most:
        return most[2 : 2 + (len(most) - 2) // 2]
    others = dict.fromkeys(label[:-1] for label in now.bands)
    return next((dof for dof in others if moved_band(now, before, dof)), loudest)


def unchanged(now: Chain, before: Chain, why_not: str = "") -> str:
    """Sentence for a change without effects, or with effects too small to name."""
    tables = [chain.table().in_units().named() for chain in (now, before)]
    numbers = [np.concatenate(list(table.values())) for table in tables]
    alike = numbers[0].size == numbers[1].size and np.allclose(
        numbers[0], numbers[1], rtol=_SAME, atol=_SAME, equal_nan=True
    )
    if now.silent:
        return "at rest hardly anything changes"
    if not alike:
        return "hardly anything changes"
    return "nothing changes" + (f", as {why_not}" if why_not else "")


def why_stiffer(now: Chain, before: Chain, along: str) -> str:
    """Say why the first named stiffness changed, from contact angles and loaded balls."""
    term = next(iter(named_terms(now, before, along)), "")
    leant = math.log(now.radial_share / before.radial_share)
    changed = math.log1p(_change(now, before, term))
    if leant * changed > 0.0 and abs(leant) >= 0.5 * abs(changed):
        more = "more" if leant < 0.0 else "less"
        return f"contacts lean {more} (cos²α {before.radial_share:.2f} → {now.radial_share:.2f})"
    return why_softer(
        term, (now.stiffness, now.loaded_balls), (before.stiffness, before.loaded_balls), True
    )


def band_follows(now: Chain, before: Chain, label: str) -> bool:
    """True if a band and the stiffness along it both rise, or both fall."""
    moved = sum(now.bands[label]) - sum(before.bands[label])
    return moved * _change(now, before, f"k_{label[:-1] * 2}") > 0.0


def moved_load(now: Chain, before: Chain, by_defect: bool = False) -> str:
    """Shift of the load to other balls, in words.

    `by_defect`: only the defect was changed. Neighbours take over load only if they carry more.
    """
    around = math.degrees(now.direction - before.direction)
    around = abs((around + 180.0) % 360.0 - 180.0)
    if around >= math.degrees(LEAST_TURN):
        return f"the load turns by {style.number(around, 2)}°"
    turned = now.off_line - before.off_line
    if turned >= LEAST_TURN:
        if by_defect and now.greatest_load > before.greatest_load:
            return "the balls beside the defect take over the load"
        return "load spreads to balls farther from its line"
    if turned <= -LEAST_TURN:
        if by_defect:
            return "balls near the line of the load carry more of it"
        return "load gathers on balls nearer its line"
    return ""


def greatest_load_words(now: Chain, before: Chain) -> str:
    """Change of the load of the most loaded ball, in words; empty if it is small."""
    grown = _ratio(now.greatest_load, before.greatest_load)
    return f"the greatest load of a ball {_growth(grown)}" if abs(grown) >= LEAST_LOAD else ""


def named_terms(now: Chain, before: Chain, along: str) -> list[str]:
    """Terms whose change is named: that along a direction, and another that changes more."""
    main = f"k_{along}{along}"
    main_change = abs(_change(now, before, main))
    others = [term for term in now.stiffness if term != main]
    most = max(others, key=lambda term: abs(_change(now, before, term)), default=main)
    terms = [main] if main_change >= LEAST else []
    if abs(_change(now, before, most)) >= max(_SECOND * main_change, LEAST) and most != main:
        terms.append(most)
    return terms


def moved_band(now: Chain, before: Chain, along: str) -> str:
    """Label of a mode whose band moves along a direction, together with the loudest line.

    If the line moves with no band, it is the mode that moves most; empty if no band moves.
    """

    def moved(label: str) -> float:
        ends = zip(now.bands[label], before.bands[label], strict=True)
        return max(abs(_ratio(new, old)) for new, old in ends)

    common = [label for label in now.bands if label[:-1] == along and label in before.bands]
    if not all(is_same_mode(label, now, before) for label in common):
        return ""
    labels = [label for label in common if moved(label) >= LEAST]
    if along in now.peaks and along in before.peaks:
        for label in labels:
            if _goes_along(
                now.peaks[along], before.peaks[along], now.bands[label], before.bands[label]
            ):
                return label
    return max(labels, key=moved, default="")


def is_same_mode(label: str, now: Chain, before: Chain) -> bool:
    """True if a label names the same mode before and now.

    Modes in another order count as the same only if the stiffness along them explains the move.
    """
    grown = sum(now.bands[label]) / sum(before.bands[label])
    stiffer = 1.0 + _change(now, before, f"k_{label[:-1] * 2}")
    room = _OF_STIFFNESS * abs(math.log(stiffer)) + _SHIFT
    return have_same_order(label, now.bands, before.bands) or abs(math.log(grown)) <= room


def band_words(label: str, now: tuple[float, float], before: tuple[float, float]) -> str:
    """Move of a band, in words."""
    low, high = (_ratio(new, old) for new, old in zip(now, before, strict=True))
    name = mode_symbol(label)
    still = 0.5 * LEAST
    if min(low, high) > -still:
        verb = "rises"
    elif max(low, high) < still:
        verb = "sinks"
    else:
        verb = "widens" if low < 0.0 else "narrows"
    return f"{name} {verb} from {_band(before)} to {_band(now)} Hz"


def peak_words(now: Chain, before: Chain, along: str, label: str) -> str:
    """Change of the loudest line in words, "with it" if it moves with the band of a mode."""
    if along not in now.peaks or along not in before.peaks:
        return ""
    new, old = now.peaks[along], before.peaks[along]
    louder = new.level - old.level
    level = ""
    if abs(louder) >= ALMOST_NONE:
        where = "" if along == now.loudest else f" along {along}"
        hertz = f"{(new if louder > 0.0 else old).frequency:.0f} Hz"
        if louder < 0.0:
            return f"hardly any vibration is left{where} at {hertz}"
        return f"vibration appears{where} at {hertz}"
    if abs(louder) >= LEAST_LEVEL:
        level = f"{style.number(abs(louder), 2)} dB {'higher' if louder > 0.0 else 'lower'}"
    moved = new.frequency - old.frequency
    if abs(moved) <= 1.01 * max(new.resolution, old.resolution):
        where = "" if along == now.loudest else f" along {along}"
        return f"the spectrum's peak{where} at {new.frequency:.0f} Hz is {level}" if level else ""
    to = f"from {old.frequency:.0f} to {new.frequency:.0f} Hz"
    with_it = bool(label) and _goes_along(new, old, now.bands[label], before.bands[label])
    words = "the spectrum's peak with it" if with_it else f"the spectrum's peak along {along} moves"
    return f"{words}, {to}" if with_it else f"{words} {to}" + (f", {level}" if level else "")


def _goes_along(
    new: Peak, old: Peak, band: tuple[float, float], former: tuple[float, float]
) -> bool:
    """True if the peak lies in the band both times, and both move the same way."""

    def lies_inside(peak: Peak, band: tuple[float, float]) -> bool:
        return band[0] - peak.resolution <= peak.frequency <= band[1] + peak.resolution

    same_way = (new.frequency - old.frequency) * (sum(band) - sum(former)) > 0.0
    return lies_inside(new, band) and lies_inside(old, former) and same_way


def _change(now: Chain, before: Chain, term: str) -> float:
    if term not in now.stiffness or term not in before.stiffness:
        return 0.0
    return _ratio(now.stiffness[term], before.stiffness[term])


def _ratio(now: float, before: float) -> float:
    """Relative growth of a number; 0 if it is not finite."""
    grown = now / before - 1.0 if before else 0.0
    return grown if math.isfinite(grown) else 0.0


def _growth(grown: float) -> str:
    if grown >= 1.0:
        return f"rises to {style.number(1.0 + grown, 2)} times"
    if grown <= -0.995:
        return f"falls to {style.number(100.0 * (1.0 + grown), 2)} %"
    return f"{'rises' if grown > 0.0 else 'falls'} by {style.number(100.0 * abs(grown), 2)} %"


def _band(band: tuple[float, float]) -> str:
    low, high = (f"{end:.0f}" for end in band)
    return low if low == high else f"{low}–{high}"
