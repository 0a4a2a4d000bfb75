"""The stability map on the page: what is sent is what was computed."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import limits_of
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import sweep
from bearing_explorer.explorer.views.stability_map import (
    GRIDS,
    KINDS,
    OrbitStability,
    codes_of,
    compute,
    legend,
)
from bearing_explorer.explorer.views.swept_view import Swept
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import orbit
from bearingcore.dynamics.stability_maps import OUTCOMES
from tests.helpers.stability import RIG, found_map


def test_each_point_has_the_kind_of_its_orbit() -> None:
    found = found_map()
    codes = codes_of(found.result)
    for j, extent in enumerate(found.sweeps[1].values):
        for i, speed in enumerate(found.sweeps[0].values):
            single = orbit(
                RIG.replace(shaft_speed=2.0 * math.pi * speed, extent=math.radians(extent))
            )
            kind = KINDS[int(codes[j, i])]
            assert (kind.outcome, kind.through) == (single.status, single.through)
    assert KINDS[int(codes[0, 2])].through == "-1"


def test_every_outcome_of_the_core_has_a_kind_and_each_a_colour() -> None:
    assert {kind.outcome for kind in KINDS} == set(OUTCOMES) - {"not computed"}
    assert len({kind.color for kind in KINDS}) == len(KINDS)
    assert all(kind.words in legend() for kind in KINDS[1:])


def test_the_picture_carries_values_and_place() -> None:
    found = found_map()
    packed = PackedSource()
    view = OrbitStability(packed)
    assert view.all_data(Results(RIG))[0]["stability_cells"]["packed"].size == 0
    view.found = found
    sources, ranges = view.all_data(Results(RIG))
    sent = sources["stability_cells"]["packed"]
    assert sent[:6].tolist() == pytest.approx([3, 2, 5.0, 30.0, 0.05, 51.4])
    np.testing.assert_array_equal(sent[9 : 9 + 6].reshape(2, 3), found.result.multiplier)
    np.testing.assert_array_equal(sent[15:].reshape(2, 3), codes_of(found.result))
    assert sent[6] == 1.0
    assert sources["stability_mark"]["x"] == pytest.approx([7.0])
    assert sources["stability_mark"]["y"] == pytest.approx([12.9])
    assert ranges["stability_x"] == (5.0, 35.0)
    assert packed.pack(sources, ranges).size > 3
    assert len(view.table(Results(RIG))["outcome"].ravel()) == 6


def test_a_cancelled_refinement_keeps_the_last_whole_picture() -> None:
    job = Work()
    job.started = time.monotonic()
    shown: list[Swept] = []

    def show(found: Swept) -> None:
        shown.append(found)
        job.stop()

    job.show = show  # type: ignore[method-assign]
    limits = limits_of(RIG)
    x = sweep("shaft_speed_hz", "20", "40", 97, limits)
    y = sweep("extent_deg", "5", "15", 97, limits)
    words = compute(job, RIG, x, y, 97)
    assert words.startswith("13 × 13")
    assert len(shown) == 1
    assert shown[0].result.completed


@pytest.mark.parametrize(
    ("change", "words"),
    [({"grid": "5000"}, f"at most {GRIDS[-1]}"), ({"x_from": ""}, "missing")],
)
def test_what_is_too_large_or_senseless_is_refused_with_a_sentence(change, words) -> None:
    view, editor = OrbitStability(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match=words):
        view.prepare({**view.form(editor)[0], **change}, editor)
