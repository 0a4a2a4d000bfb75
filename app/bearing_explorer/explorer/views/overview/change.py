"""Effect of the last change along the chain, in one sentence."""

from __future__ import annotations

from typing import Any

import numpy as np
import panel as pn

from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.difference import difference
from bearing_explorer.explorer.views.overview.words import Cause, story
from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.sentences import label_inside
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearingcore import Bearing, Scene
from bearingcore.common import number
from bearingcore.fields import FIELD_OF

_PLAY = ("contact_angle", "radial_clearance")
"""Fields of a bearing that determine its play."""
_NOTHING = (
    "There is no defect, and nothing has been changed yet: move a slider to see its effect here, "
    "from the loads to the vibration."
)


class LastChange(View):
    """A sentence on the last change; the table holds its numbers, before and now."""

    name = "last-change"
    title = "Effect of your last change"
    about = (
        "Computed for each change, against the scene before it. Means are over all cage angles. "
        "sin²φ: the share of the radial stiffness that is vertical. Small changes are not "
        "named: stiffness and natural frequencies by less than 1 %, the greatest load of a ball "
        "by less than 5 %, the loudest line by less than 2 dB. Before the first change the scene "
        "is compared with the bearing without its defect."
    )
    needs = frozenset({"chain", "before", "late_spectra", "reference"})
    compact = True

    def build(self, packed: PackedSource) -> Any:
        return pn.Spacer(height=0, margin=0)

    def sentence(self, results: Results) -> str:
        before = results.before
        if before is not None:
            words = difference(results.scene, before.scene, results.focus)
        elif results.scene.defects:
            words = ""
        else:
            return _NOTHING
        reference = before or results.grey
        now, then = results.scene, reference.scene
        played = now.bearing != then.bearing and _alike_but_for_play(now.bearing, then.bearing)
        only_play = played and then.replace(bearing=now.bearing) == now
        cause = Cause(
            words,
            defect=now.healthy() == then.healthy(),
            masses=now.support != then.support,
            weighs=_masses_words(now, then, words),
            contacts=(now.bearing != then.bearing and not played) or now.balls != then.balls,
            why_not="" if before is None else why_not(now, then),
            play=reasons.play(now.bearing, then.bearing) if only_play else "",
        )
        text = story(cause, results.chain, results.chain_of(reference))
        return with_elements_of(now.bearing, text)

    def title_of(self, results: Results) -> str:
        nothing_yet = results.before is None and results.scene.defects
        return "Compared with a healthy bearing" if nothing_yet else self.title

    def table(self, results: Results) -> dict[str, np.ndarray]:
        now = results.chain.table().in_units().named()
        before = results.chain_of(results.before or results.grey).table().in_units().named()
        return {
            "number": np.array(list(now)),
            "before": np.array([_only(before.get(name)) for name in now]),
            "now": np.array([_only(column) for column in now.values()]),
        }


def _alike_but_for_play(now: Bearing, before: Bearing) -> bool:
    """True if two bearings differ only in contact angle and clearance."""
    try:
        return now.replace(**{name: getattr(before, name) for name in _PLAY}) == before
    except ValueError:  # a bearing of another kind, to which these numbers do not fit
        return False


def _masses_words(now: Scene, before: Scene, words: str) -> str:
    """Changed masses of rotor and housing that the cause does not name, in words."""
    masses = [
        f"the {part} is {number(after)} kg instead of {number(former)} kg"
        for part, name in (("rotor", "inner_mass"), ("housing", "outer_mass"))
        for after, former in [(getattr(now.support, name), getattr(before.support, name))]
        if after != former and label_inside(FIELD_OF[name]) not in words.lower()
    ]
    return f"frequencies go with √(k/m): {' and '.join(masses)}" if masses else ""


def why_not(now: Scene, before: Scene) -> str:
    """Reason why a change may leave all loads unchanged; empty if it is not known."""
    if len(now.defects) != 1 or len(before.defects) != 1:
        return ""
    if now.defects[0].floor is None and now == before.replace(depth=now.defects[0].depth):
        return "no ball is pressed against the floor of the defect at either depth"
    return ""


def _only(column: np.ndarray | None) -> float:
    return float(column[0]) if column is not None and column.size else np.nan
