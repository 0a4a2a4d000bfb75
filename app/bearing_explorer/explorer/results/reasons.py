"""Reasons for results: one sentence for each, from the results alone.

If the results show no reason, the sentence is empty or says so.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.explorer.results.chain import LOWEST_PEAK, Peak, direction
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import element_name, elements
from bearingcore import DOF_NAMES
from bearingcore.common import prefixed_span
from bearingcore.model.scene import DOF_SYMBOLS
from bearingcore.model.statics import BALL_LOAD, TERM_SYMBOLS, TERM_UNITS, drops_at
from bearingcore.model.sweeps import mode_symbol

if TYPE_CHECKING:
    from bearing_explorer.explorer.results.excerpt import Excerpt
    from bearing_explorer.explorer.results.results import Results
    from bearingcore import Bearing, Equilibrium, Scene, Spectrum

LEAST = 0.01
"""Least relative change of a stiffness that counts as a change."""
ALIKE = 0.01
"""Balls whose load differs by at most this share from the greatest one carry the most together."""
NEAR = 0.65
"""Least mean cos²φ of loaded balls that lie near an axis; all balls of one side have 0.5 to 0.6."""
SEPARATE = 4.0
"""Least distance of separate peaks in lines of a spectrum; a Hann window widens each to four."""
STANDS_OUT = 3.0
"""Height [dB] of a peak over its surroundings, which lie halfway to its neighbours."""
LOADED = 0.01
"""Share of the greatest load at rest from which a ball counts as loaded."""
AT_AN_EDGE = 0.07
"""Share of an excerpt, a tenth of a ball pass: a jolt farther from an edge has another cause."""
LEAST_KEPT_SHARE = 0.25
"""Share of its greatest load that a ball must carry throughout, or it counts as unloaded."""
LARGE_SWING = 1.25
"""Ratio of the greatest load in motion to that at rest, above which a swing is not small."""
_ACROSS = {"x": "the horizontal", "y": "the vertical"}
_OTHER = {"x": "up and down", "y": "sideways"}
RADIAL = ("k_xx", "k_yy")
"""The radial stiffness."""
_SQUARE = {"x": "cos²φ", "y": "sin²φ"}


# --- loads ----------------------------------------------------------------------------------------


def most_loaded(
    scene: Scene,
    states: Equilibrium,
    state: int,
    drop: NDArray[np.float64],
    *,
    briefly: bool = False,
) -> str:
    """Say which ball carries the most in a state, and why; `drop` [m] of each ball into defects."""
    load, bearing = states.ball_load[state], scene.bearing
    if not (np.isfinite(load).all() and load.max() > 0.0):
        return ""
    most = np.flatnonzero(load >= (1.0 - ALIKE) * load.max())
    several = most.size > 1
    load_words = f"{style.with_prefix(load.max(), 'N')}{' each' if several else ''}"
    line = direction(scene)
    if most.size == load.size:
        return f"All {elements(bearing)} carry alike, {load_words}: nothing loads one side."
    names = _element_names(bearing, most)
    text = f"{names[0].upper()}{names[1:]} {'carry' if several else 'carries'} most"
    text += "" if briefly else f", {load_words}"
    # elements nearer to the load's line would be expected to carry more
    apart = np.abs((states.ball_angle[state] - line + math.pi) % (2.0 * math.pi) - math.pi)
    nearer = np.flatnonzero(apart < apart[most].min() - 1e-6)  # none without a line, which is NaN
    where = _place_words(float(apart[most].min()), bool(nearer.size), not several)
    # elements that lost their load: deeper in a defect than those that carry most
    lost = (drop > drop[most].max()) & (load < (1.0 - ALIKE) * load.max())
    inside, adjacent = nearer[lost[nearer]], _neighbours(bearing, most)
    gone = inside if inside.size else adjacent[lost[adjacent]]
    gone_names, single = _element_names(bearing, gone), gone.size == 1
    if briefly:
        if gone.size and (nearer.size or math.isnan(line)):
            return f"{text}: {gone_names} {'is' if single else 'are'} in the defect."
        return f"{text}: {where.partition(',')[0]}."
    if not gone.size:
        return f"{text}: {where}."
    left = style.with_prefix(load[gone].max(), "N")
    carry = f"only {left}" if single else f"at most {left} each"
    carry = carry if load[gone].max() > 0.0 else "nothing"
    place = (
        "nearer the line of the load" if inside.size else f"beside {'them' if several else 'it'}"
    )
    verbs = ("lies", "carries") if single else ("lie", "carry")
    why = f"{gone_names}, {place}, {verbs[0]} in the defect and {verbs[1]} {carry}"
    return f"{text}: {why}." if inside.size or math.isnan(line) else f"{text}: {where}; {why}."


def _place_words(apart: float, is_off: bool, single: bool) -> str:
    """Place of the elements that carry most, `apart` [rad] from the load's line, in words.

    `is_off`: others are nearer to the line. `apart` is NaN without a line.
    """
    if math.isnan(apart) or is_off:
        return "the rings are pressed together most there"
    off = style.in_degrees(apart, 0)
    near = "on the line of the load" if off == "0°" else f"nearest the line of the load ({off})"
    lies = "it lies" if single else "they lie"
    return f"{lies} {near}, where the rings are pressed together most"


def _neighbours(bearing: Bearing, which: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of the elements beside these in their rows."""
    adjacent = [
        row.start + (int(k) - row.start + side) % (row.stop - row.start)
        for row in bearing.balls_of_rows
        for k in which
        if row.start <= k < row.stop
        for side in (-1, 1)
    ]
    return np.unique(np.array(adjacent, dtype=np.int64))


def greatest_load(results: Results) -> str:
    """Say why a ball carries the most at the worst cage angle, and name that angle."""
    states = results.ranges.state
    load = np.where(states.converged[:, None], states.ball_load, -1.0).max(axis=1)
    state = [int(np.argmax(load))]
    if load[state] <= 0.0:
        return ""
    angle = states.cage_angles[state]
    drop = drops_at(results.scene, angle, None, states.leads[state])[0]
    why = most_loaded(results.scene, states, state[0], drop)
    return (
        f"It occurs with the cage at {style.in_degrees(angle[0])}. There {why[0].lower()}{why[1:]}"
    )


def _element_names(bearing: Bearing, which: NDArray[np.int64]) -> str:
    """Names of elements, row by row: "balls 10 and 12"; for more than six only their number."""
    rows: dict[int, list[str]] = {}
    for k in which:
        row, number = bearing.row_of_ball(int(k))
        rows.setdefault(row, []).append(str(number + 1))
    names = []
    for row, numbers in rows.items():
        count, several = len(numbers), elements(bearing, len(numbers))
        name = f"{several} {style.list_words(numbers)}" if count <= 6 else f"{count} {several}"
        names.append(name if len(bearing.all_rows) == 1 else f"{name} of row {row + 1}")
    return style.list_words(names)


# --- stiffness ------------------------------------------------------------------------------------


def radial(results: Results) -> tuple[dict[str, float], float]:
    """Mean stiffness [N/m] along x and y over all positions, and mean number of loaded balls."""
    ranges = results.ranges
    states = ranges.state
    balls = ranges.mean(np.where(states.converged, states.loaded_balls, math.nan))
    terms = [f"k_{dof}{dof}" for dof in ("x", "y") if dof in states.dofs]
    return {term: ranges.mean(states.term(term)) for term in terms}, balls


def why_softer(
    term: str,
    now: tuple[Mapping[str, float], float],
    before: tuple[Mapping[str, float], float],
    briefly: bool = False,
) -> str:
    """Say why the mean of k_xx or k_yy changed, from the means and numbers of `radial`.

    A contact at φ with stiffness k adds k·cos²φ to k_xx and k·sin²φ to k_yy. So their sum is the
    stiffness of all contacts, and the share of one term is the mean cos²φ or sin²φ. Empty if the
    means do not show the reason.
    """
    (stiff, balls), (former, balls_before) = now, before
    if not {term, "k_xx", "k_yy"} <= set(stiff) & set(former):
        return ""
    total, total_before = (means["k_xx"] + means["k_yy"] for means in (stiff, former))
    if not (min(stiff[term], former[term], balls, balls_before) > 0.0):
        return ""
    share, share_before = stiff[term] / total, former[term] / total_before
    # ln(term ratio) = ln(share ratio) + ln(total ratio): name each part that has the sign of the
    # change and at least half the size of the other
    turned, grown = math.log(share / share_before), math.log(total / total_before)
    more = math.log(balls / balls_before)
    dof = term[-1]
    rises = stiff[term] > former[term]
    reasons = []
    if (turned > 0.0) == rises and abs(turned) >= 0.5 * abs(grown):
        how = "farther from" if turned < 0.0 else "nearer"
        push = "more" if turned < 0.0 else "less"
        lie = "" if briefly else f"loaded balls lie {how} {_ACROSS[dof]} and "
        reasons.append(
            f"{lie or 'balls '}push back {push} {_OTHER[dof]} "
            f"({_SQUARE[dof]} {change_words(share_before, share)})"
        )
    if (grown > 0.0) == rises and abs(grown) >= 0.5 * abs(turned):
        if (more > 0.0) == rises and abs(more) >= 0.5 * abs(grown):
            many = "more" if more > 0.0 else "fewer"
            reasons.append(
                f"{many} balls carry ({style.number(balls_before)} → {style.number(balls)})"
            )
        else:
            reasons.append(f"each contact is {'stiffer' if grown > more else 'softer'} on average")
    return style.list_words(reasons)


def change_words(before: float, now: float) -> str:
    """Two numbers with the fewest decimals that distinguish them, at least two."""
    places = next((n for n in range(2, 9) if f"{before:.{n}f}" != f"{now:.{n}f}"), 9)
    return f"{before:.{places}f} → {now:.{places}f}"


def stiffness(results: Results, *, briefly: bool = False) -> str:
    """Say why the radial stiffness differs from the healthy one, or between x and y."""
    now = radial(results)
    means = now[0]
    if len(means) < 2 or not all(map(math.isfinite, means.values())):
        return ""
    if results.scene.defects and results.grey.label:
        words = _stiffness_against(results, now, briefly)
        if words:
            return words
    share = means["k_yy"] / (means["k_xx"] + means["k_yy"])
    if 0.45 <= share <= 0.55:
        return f"k_xx and k_yy are alike: balls carry all around (mean sin²φ {share:.2f})."
    dof, other = ("y", "x") if share > 0.5 else ("x", "y")
    large, small = max(share, 1.0 - share), min(share, 1.0 - share)
    push = f"lie near {_ACROSS[dof]} and push back along it"
    if large < NEAR:
        push = f"push back more along {_ACROSS[dof]} than along {_ACROSS[other]}"
    if briefly:
        return (
            f"k_{dof}{dof} is {style.number(large / small, 2)} times k_{other}{other}: balls "
            f"push back more along {_ACROSS[dof]} ({_SQUARE[dof]} {large:.2f})."
        )
    return (
        f"k_{dof}{dof} is {style.number(large / small, 2)} times k_{other}{other}: loaded balls "
        f"{push} ({_SQUARE[dof]} {large:.2f} on average, {_SQUARE[other]} {small:.2f})."
    )


def _stiffness_against(results: Results, now: tuple[dict[str, float], float], briefly: bool) -> str:
    """Say how and why the radial stiffness differs from the healthy one; empty if unknown."""
    means, before = now[0], radial(results.reference)
    grown = {term: means[term] / before[0][term] - 1.0 for term in means}
    most = max(grown, key=lambda term: abs(grown[term]))
    along = direction(results.scene)  # the stiffness that carries the load first
    term = "k_yy" if math.isnan(along) or abs(math.sin(along)) > 0.5 else "k_xx"
    term = term if abs(grown[term]) >= LEAST else most
    if not math.isfinite(grown[term]):
        return ""
    if abs(grown[term]) >= LEAST:
        verb = "rises" if grown[term] > 0.0 else "falls"
        percent = style.number(100.0 * abs(grown[term]), 2)
        why = why_softer(term, now, before, briefly)
        if briefly and why:
            return f"{term} {verb}: {why}."
        text = f"With the defect {term} {verb} by {percent} % on average"
        return f"{text}: {why}." if why else f"{text}."
    if abs(now[1] - before[1]) < LEAST * before[1]:
        many = style.number(now[1])
        return (
            "The defect hardly changes the mean stiffness: as many balls carry as without it "
            f"({many} on average), at the same angles."
        )
    return ""


_LEVER = {"x": "cosα·cosφ", "y": "cosα·sinφ", "z": "sinα"}
"""Component of a contact's unit vector along a direction."""


def stiffness_term(results: Results, term: str) -> str:
    """Explain a term of the stiffness by what each contact adds to it."""
    states = results.equilibrium
    if not states.converged.any():
        return ""
    first, other = next((a, b) for a in DOF_NAMES for b in DOF_NAMES if term == f"k_{a}{b}")
    symbol = TERM_SYMBOLS[term].replace(" ", "_", 1)
    least, most = np.nanmin(states.term(term)), np.nanmax(states.term(term))
    size = max(abs(least), abs(most))
    # zero is judged by the geometric mean of the two diagonal terms
    diagonal = (states.term(f"k_{dof}{dof}") for dof in (first, other))
    scale = math.sqrt(math.prod(float(np.nanmax(np.abs(values))) for values in diagonal))
    if size <= 1e-6 * scale:
        if first == other:
            return f"{symbol} is zero: no contact resists {DOF_SYMBOLS[first]}."
        return f"{symbol} is zero: {DOF_SYMBOLS[first]} and {DOF_SYMBOLS[other]} are not coupled."
    if not {first, other} <= _LEVER.keys():
        span = prefixed_span(least, most, TERM_UNITS[term])
        levers = f"levers of {DOF_SYMBOLS[first]} and {DOF_SYMBOLS[other]}"
        if first == other:
            levers = f"square of the lever of {DOF_SYMBOLS[first]}"
        return (
            f"{symbol} {'varies from' if ' to ' in span else 'is'} {span}: each contact adds its "
            f"stiffness, multiplied by the {levers}."
        )
    if first == other:
        why = ""
        if term in RADIAL and results.scene.defects and results.grey.label:
            why = why_softer(term, radial(results), radial(results.reference))
        why = f" With the defect, {why}." if why else ""
        balls = states.loaded_balls[states.converged]
        if balls.min() < balls.max():
            place = "the loaded zone" + (" or the defect" if results.scene.defects else "")
            steps = f"{symbol} steps as balls enter or leave {place}"
            why = f" A ball without load adds nothing, so {steps}.{why}"
        return f"Each contact of stiffness k adds k·({_LEVER[first]})² to {symbol}.{why}"
    text = f"Each contact of stiffness k adds k·({_LEVER[first]})·({_LEVER[other]}) to {symbol}, "
    if least < -ALIKE * size and most > ALIKE * size:
        return (
            f"{text}of either sign: contacts left and right cancel, and the side that "
            "prevails changes as balls pass."
        )
    return f"{text}and one sign prevails: contacts on one side are stiffer, or more."


STIFF_WHERE_HELD = "Directions that are held have a stiffness as well."
"""Why terms of directions that cannot move have values: the stiffness is the bearing's."""


def not_needed(scene: Scene, *, briefly: bool = False) -> str:
    """Say in which directions the rings are held, and why; empty if all are free."""
    held = [dof for dof in DOF_NAMES if dof not in scene.active_dofs]
    if not held:
        return ""
    words = _why_held(scene, held, briefly)
    # the sentence is false for rollers and self-aligning balls: they do not resist tilt
    resists = not scene.bearing.kind.left_out or set(held) <= set(
        scene.bearing.kind.needed_directions
    )
    return f"{words} {STIFF_WHERE_HELD}" if resists and not briefly else words


def _why_held(scene: Scene, held: list[str], briefly: bool) -> str:
    """Say why these directions are held: by default, by choice, or because nothing moves them."""
    names = style.list_words([DOF_SYMBOLS[dof] for dof in held])
    if scene.holds_tilt_unasked:
        return f"{names} are held, as by the shaft's other bearing."
    if scene.active_dofs != scene.needed_dofs:
        return f"{names} {'is' if len(held) == 1 else 'are'} held by choice."
    free = style.list_words([DOF_SYMBOLS[dof] for dof in DOF_NAMES if dof not in held])
    text = f"Only {free} matter here"
    if briefly:
        return f"{text}."
    kind = scene.bearing.kind
    why = [kind.left_out] if set(held) - set(kind.needed_directions) and kind.left_out else []
    if scene.active_dofs != kind.needed_directions:
        tilts = "rx" in kind.needed_directions
        why.append("no load along the shaft" + (", no moment" if tilts else ""))
    return f"{text}: {'; '.join(why)}." if why else f"{text}."


def play(now: Bearing, before: Bearing) -> str:
    """Say how contact angle and clearance change the play 2·(A₀·(1 − cos α₀) + r_L)."""
    old, new = before.diametral_play, now.diametral_play
    if abs(new - old) < ALIKE * max(abs(new), abs(old)):
        return ""
    text = f"the play {'grows' if new > old else 'shrinks'} from {_micro(old)} to {_micro(new)}"
    of_angle = new - 2.0 * now.radial_clearance
    if abs(of_angle) <= ALIKE * abs(new):
        return text
    rest = f", {_micro(2.0 * now.radial_clearance)} the clearance" if now.radial_clearance else ""
    return f"{text} ({_micro(of_angle)} of it the contact angle{rest})"


def _micro(length: float) -> str:
    return style.with_prefix(length, "m", 2) if length else "0"


# --- natural frequencies --------------------------------------------------------------------------


def frequencies(results: Results) -> str:
    """Say which natural frequency moves most, and why."""
    ranges = results.ranges
    widths = {
        label: high / low
        for label, (low, high) in results.bands.items()
        if label[:-1] in ("x", "y") and low > 0.0
    }
    if not widths:
        return ""
    label = max(widths, key=lambda label: widths[label])
    term = f"k_{label[:-1] * 2}"
    ratio = ranges.greatest[term] / ranges.least[term] if ranges.least[term] > 0.0 else math.nan
    if not ratio > 1.0:
        return ""
    name = mode_symbol(label)
    moves, varies = (f"{style.number(100.0 * (x - 1.0), 2)} %" for x in (widths[label], ratio))
    if ratio < 1.0 + LEAST:
        return f"The bands are narrow because {term} varies by no more than {varies}."
    power = math.log(widths[label]) / math.log(ratio)
    text = f"{name} moves most, by {moves}, because {term} varies by {varies}"
    if power > 0.55:
        return f"{text}, and other terms with it."
    if power >= 0.45:
        return f"{text}: a frequency follows the square root of the stiffness."
    return f"{text}: less than its square root, as the support's stiffness does not vary."


# --- vibration ------------------------------------------------------------------------------------

HEALTHY_SHAKES = (
    "No defect: a healthy bearing also shakes as its balls pass, because as they change places the "
    "stiffness under the load changes."
)
"""Reason for peaks at the ball-pass frequency that could be taken for the sign of a defect."""


def ball_pass_peak(
    spectrum: Spectrum,
    rate: float,
    lowest_mode: float,
    *,
    briefly: bool = False,
) -> str:
    """Say whether the spectrum has a peak at the ball-pass frequency `rate` [Hz], and if not why.

    `lowest_mode` [Hz]: the least natural frequency. `briefly`: empty if the spectrum is too
    coarse to show it.
    """
    frequency, density = spectrum
    spacing = float(frequency[1] - frequency[0])
    hertz = style.with_prefix(rate, "Hz")
    if not rate > 0.0:
        return ""
    if rate < SEPARATE * spacing:
        if briefly:
            return ""
        return (
            f"No peak at the ball-pass frequency, {hertz}: this spectrum resolves only "
            f"{spacing:.0f} Hz. Each pass is seen in time (Vibration, every "
            f"{style.with_prefix(1.0 / rate, 's')}) and in the envelope (Diagnosis)."
        )
    level = 10.0 * np.log10(np.maximum(density, 1e-20))
    line = round(rate / spacing)
    height = level[line - 1 : line + 2].max()
    valleys = [level[round(share * rate / spacing)] for share in (0.5, 1.5)]
    below = f"{style.number(float(level.max() - height), 2)} dB below the largest peak"
    if height - max(valleys) < STANDS_OUT:
        text = f"No peak stands out at the ball-pass frequency, {hertz}: "
        if not rate < lowest_mode:
            return f"{text}there the level is {below}."
        return f"{text}such a slow force moves the housing little, {below}."
    most = float(frequency[int(np.argmax(level))])
    if abs(most - max(round(most / rate), 1) * rate) <= 0.51 * spacing:
        return f"Peaks stand {hertz} apart, the ball-pass frequency."
    return f"A peak stands at the ball-pass frequency, {hertz}, {below}."


def peak(results: Results, rates: Sequence[float], *, briefly: bool = False) -> str:
    """Explain the largest peak of the settled vibration; `rates` [Hz] of ball passes."""
    peaks = results.peaks
    if not peaks:
        return ""
    dof = max(peaks, key=lambda name: peaks[name].level)
    most = peaks[dof]
    frequency, density = results.late_spectra[dof]
    is_low = frequency < LOWEST_PEAK
    lower = density[is_low].max(initial=0.0) > density[~is_low].max(initial=0.0)
    above = f" above {LOWEST_PEAK:.0f} Hz" if lower else ""
    text = f"The largest peak{above}, {most.frequency:.0f} Hz along {dof},"
    bands = {label: band for label, band in results.bands.items() if not math.isnan(band[0])}
    inside = [label for label, band in bands.items() if _distance(most, band) <= most.resolution]
    if alike := [label for label in inside if label[:-1] == dof]:
        if briefly:
            name = mode_symbol(alike[0])
            return f"The highest peak{above} is the {name} resonance, struck by every passing ball."
        return f"{text} {_lies(most, alike[0], bands)}: each passing ball excites this mode."
    if times := _ball_pass_words(most, rates):
        if briefly:
            return f"The highest peak{above} is at {times}."
        return (
            f"{text} lies in no band of {dof}. It is the line nearest {times} (lines "
            f"are {most.resolution:.0f} Hz apart)."
        )
    if inside:
        words = _lies(most, inside[0], bands)
        return f"{text} {words}: along {dof} the housing takes part in that swing."
    if not bands:
        return ""
    label = min(bands, key=lambda name: _distance(most, bands[name]))
    side = "below" if most.frequency < bands[label][0] else "above"
    text += f" lies in no band, {_distance(most, bands[label]):.0f} Hz {side} {mode_symbol(label)}"
    moving, still = results.load_in_motion, results.ranges.greatest[BALL_LOAD]
    if moving is not None and moving > LARGE_SWING * still:
        times = style.number(moving / still, 2)
        return (
            f"{text}: bands hold for small swings, and here a ball carries {times} times as much "
            "as at rest."
        )
    return f"{text}; the results here do not show why."


def _ball_pass_words(most: Peak, rates: Sequence[float]) -> str:
    """A peak as a multiple of a rate [Hz] of ball passes, with the reason; else empty."""
    for rate in rates:
        halves = round(2.0 * most.frequency / rate) if rate > 0.0 else 0
        resolved = rate >= SEPARATE * most.resolution and halves > 0
        if resolved and abs(most.frequency - 0.5 * halves * rate) <= 0.51 * most.resolution:
            hertz = f"{style.number(rate, 4)} Hz"
            if halves == 2:
                return f"{hertz}, the ball-pass frequency"
            why = "a multiple of the ball passes"
            why = "so the motion does not repeat with each ball pass" if halves % 2 else why
            return f"{style.number(0.5 * halves)} × {hertz}, {why}"
    return ""


def jolt(shown: Excerpt, bearing: Bearing) -> str:
    """Say when the largest jolt comes, and which loaded ball enters or leaves a defect then."""
    if shown.broke_off or not shown.acceleration or not shown.events:
        return ""
    size = np.max([np.abs(values) for values in shown.acceleration.values()], axis=0)
    jolt_time = float(shown.time[int(np.argmax(size))])
    loads = dict(zip(shown.balls, shown.ball_load.max(axis=0, initial=0.0), strict=True))
    loaded = [e for e in shown.events if loads[e.ball] > LOADED * shown.greatest_static_load]
    if not loaded:
        return (
            "No loaded ball passes the defect: only the changing number of loaded balls shakes it."
        )
    nearest = min(loaded, key=lambda event: abs(event.time - jolt_time))
    apart = jolt_time - nearest.time
    load = shown.ball_load[:, list(shown.balls).index(nearest.ball)]
    near = AT_AN_EDGE * float(np.ptp(shown.time))
    around = load[np.abs(shown.time - jolt_time) <= near]
    swing = loads[nearest.ball] / shown.greatest_static_load
    if abs(apart) > near:
        text = "The largest jolt comes while no ball enters or leaves the defect"
        if swing <= LARGE_SWING:
            return f"{text}."
        return f"{text}: a ball carries up to {style.number(swing, 2)} times as much as at rest."
    verb, then = ("enters", "loses") if nearest.enters else ("leaves", "takes back")
    when = f"{style.with_prefix(abs(apart), 's', 2)} {'after' if apart >= 0.0 else 'before'}"
    text = f"The largest jolt comes {when} {element_name(bearing, nearest.ball)} {verb} the defect"
    if around.min() > LEAST_KEPT_SHARE * load.max():
        return f"{text}; it carries at least {style.with_prefix(around.min(), 'N', 2)} then."
    return f"{text} and {then} its load ({style.with_prefix(around.max(), 'N', 2)} at most)."


def _distance(peak: Peak, band: tuple[float, float]) -> float:
    """Distance [Hz] of a peak from a band."""
    return max(band[0] - peak.frequency, peak.frequency - band[1], 0.0)


def _lies(peak: Peak, label: str, bands: Mapping[str, tuple[float, float]]) -> str:
    where = "in" if _distance(peak, bands[label]) == 0.0 else "at the edge of"
    return f"lies {where} the band of {mode_symbol(label)}"
