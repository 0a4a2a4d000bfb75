"""A scene in the address and back: to the last bit, for ever, and whatever strangers write."""

import base64
import copy
import dataclasses
import functools
import itertools
import math
import tomllib
import tracemalloc
import zlib
from pathlib import Path
from typing import Any

import pytest
from bearing_explorer.explorer.state.address import (
    LONGEST_LINK,
    OTHER_NAMES_OF_TABS,
    Place,
    leaves_out,
    pack_points,
    place_of,
    read,
    show_text,
    unpack_points,
    write,
)
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.page import TABS
from hypothesis import given, settings, strategies as st

from bearingcore import (
    CONTACT_LAWS,
    DOF_NAMES,
    EDGES,
    RACES,
    Defect,
    MeasuredFloor,
    RoughFloor,
    Scene,
    presets,
)
from bearingcore.model.scene import TILT_FREE

FROZEN = tomllib.loads((Path(__file__).parent / "frozen_links.toml").read_text("utf-8"))["link"]


def changed(kept: Any, change: Any) -> Any:
    """Put what differs into what a file says of a scene; of lists into each of their tables."""
    if isinstance(kept, dict) and isinstance(change, dict):
        return kept | {n: changed(kept.get(n), value) for n, value in change.items()}
    if isinstance(kept, list) and isinstance(change, list) and isinstance(change[0], dict):
        pairs = itertools.zip_longest(kept, change, fillvalue={})
        return [changed(old, new) for old, new in pairs]
    return change


WHOLE: dict[str, dict[str, Any]] = {}
"""The scene of each link in full, by what the link is about."""
for _link in FROZEN:
    _scene = copy.deepcopy(WHOLE[_link["like"]]) if "like" in _link else {}
    for _name in _link.get("without", ()):
        *_parts, _last = _name.split(".")
        del functools.reduce(dict.__getitem__, _parts, _scene)[_last]
    WHOLE[_link["about"]] = _link["scene"] = changed(_scene, _link.get("scene", {}))


def numbers(least: float, most: float) -> st.SearchStrategy[float]:
    return st.floats(least, most, allow_nan=False, allow_infinity=False)


FLOORS = st.one_of(
    st.none(),
    st.builds(RoughFloor, numbers(0, 5e-4), numbers(1e-4, 1e-2), st.integers(0, 2**31 - 1)),
    st.lists(
        st.tuples(numbers(-1, 1), numbers(0, 1)), min_size=2, max_size=30, unique_by=lambda p: p[0]
    )
    .map(sorted)
    .map(lambda points: MeasuredFloor(*(tuple(column) for column in zip(*points, strict=True)))),
)
DEFECTS = st.builds(
    Defect,
    st.one_of(st.just(0.0), numbers(0.01, 0.5)),
    st.one_of(st.just(0.0), numbers(1e-6, 1e-4)),
    numbers(0.0, 2.0 * math.pi),
    st.sampled_from(RACES),
    st.sampled_from(EDGES),
    FLOORS,
)


@st.composite
def places(draw: st.DrawFn) -> Place:
    """Scenes of several numbers and defects; `test_every_field.py` has each number alone."""
    preset = draw(st.sampled_from(list(presets)))
    numbers_of_scene = {
        "fx": numbers(-1e6, 1e6),
        "shaft_speed": numbers(0, 6000),
        "contact_damping": st.one_of(st.none(), numbers(0, 1e6)),
        "stiffness_rx": st.one_of(st.none(), numbers(1e-3, 1e9)),
        "outer_mass": numbers(1e-3, 1e3),
        "n_balls": st.integers(1, 8),
        "contact_law": st.sampled_from(CONTACT_LAWS),
    }
    kind = presets[preset].bearing.kind
    if not kind.line_contact and kind.name != "self-aligning":  # which move in fewer directions
        numbers_of_scene["dofs"] = st.one_of(
            st.sampled_from([None, TILT_FREE]),
            st.lists(st.sampled_from(DOF_NAMES), min_size=1, unique=True).map(tuple),
        )
    scene = presets[preset].replace(**draw(st.fixed_dictionaries({}, optional=numbers_of_scene)))
    defects = draw(st.lists(DEFECTS, min_size=1, max_size=4))
    if len(defects) > 1:
        # defects that touch are refused: each has a part of the race of its own
        part = 2.0 * math.pi / len(defects)
        defects = [
            dataclasses.replace(d, center=(i + 0.5) * part, race=defects[0].race, edge="exact")
            for i, d in enumerate(defects)
        ]
    scene = scene.replace(defect=tuple(defects) if len(defects) > 1 else defects[0])
    tab = draw(st.sampled_from(["load", "stiffness"]))
    return Place(scene, preset, len(defects) - 1, draw(numbers(0, 360)), tab)


@settings(max_examples=100, deadline=None)
@given(places())
def test_every_scene_comes_back_to_the_last_bit(place: Place) -> None:
    text = write(place)
    assert read(text) == place
    assert text.isascii()
    assert not set(text) & set(" \"'<>#`\\")
    editor = SceneEditor("fan-rig")
    shown = show_text(text, editor)
    if not shown.note:  # else out of the limits of what can be typed
        assert place_of(editor, place.tab) == place
        assert write(shown) == text


@pytest.mark.parametrize(
    ("text", "dofs", "free"),
    [
        ("fz_n=50", TILT_FREE, DOF_NAMES),
        ("fz_n=50&dofs=auto", TILT_FREE, DOF_NAMES),
        ("fz_n=50&dofs=held", None, ("x", "y", "z")),
        ("fz_n=50&dofs=free", TILT_FREE, DOF_NAMES),
        ("fz_n=50&mx_nm=1&dofs=held", ("x", "y", "z"), ("x", "y", "z")),
        ("fz_n=50&mx_nm=1", None, DOF_NAMES),
        ("fy_n=-50", None, ("x", "y")),
        ("preset=7208-25deg&dofs=auto", TILT_FREE, DOF_NAMES),
    ],
)
def test_what_says_nothing_of_directions_has_those_that_it_had(text, dofs, free) -> None:
    """In links and in files: tilts were free before they could be held."""
    scene = read(f"v=1&{text}").scene
    assert (scene.dofs, scene.active_dofs) == (dofs, free)
    data = scene.to_data()
    assert Scene.from_data(data) == scene
    if dofs == TILT_FREE:
        assert "dofs" not in data, "programs of before read it alike"


def test_a_link_is_short_and_can_be_read() -> None:
    editor = SceneEditor("fan-rig")
    editor.set({"extent_deg": 38.6, "fy_n": -120, "cage_angle_deg": 12.5})
    assert write(place_of(editor, "stiffness")) == (
        "v=1&preset=fan-rig&extent_deg=38.6&fy_n=-120&cage_angle_deg=12.5&tab=stiffness"
    )


@pytest.mark.parametrize("link", FROZEN, ids=lambda link: link["about"])
def test_links_of_earlier_days_open(link: dict) -> None:
    """Mend what fails here, never the file: somebody has these links in a mail."""
    editor = SceneEditor("liew-lim")
    place = show_text(link["text"], editor)
    assert place.note == ""
    assert (place.cage_angle, place.tab) == (link.get("cage_angle", 0.0), link.get("tab", "load"))
    same(editor.scene.to_data(), Scene.from_data(link["scene"]).to_data())
    kept = copy.deepcopy(link["scene"])
    if "roller_length" in kept["bearing"]:  # straight races had centres too in those days
        del kept["bearing"]["groove_center_distance"]
    same(editor.scene.to_data(), kept)


@pytest.mark.parametrize(("former", "now"), OTHER_NAMES_OF_TABS.items())
def test_a_former_name_of_a_tab_leads_to_where_its_views_are(former: str, now: str) -> None:
    assert read(f"v=1&preset=fan-rig&tab={former}").tab == now
    assert now in {*dict(TABS), "diagnosis"}, "of whichever half"
    assert former not in dict(TABS)


def same(actual: object, kept: object) -> None:
    if isinstance(kept, dict):
        assert isinstance(actual, dict)
        assert actual.keys() == kept.keys()
        for name in kept:
            same(actual[name], kept[name])
    elif isinstance(kept, list) and kept and not isinstance(kept[0], str):
        assert isinstance(actual, list | tuple)
        assert len(actual) == len(kept)
        for a, b in zip(actual, kept, strict=True):
            same(a, b)
    elif isinstance(kept, float):
        assert actual == pytest.approx(kept, rel=1e-9, abs=1e-15)
    else:
        assert actual == kept


def test_every_preset_is_among_the_frozen_links() -> None:
    """A link says what differs from a preset: one whose numbers change needs a new name."""
    assert {f"v=1&preset={name}" for name in presets} <= {link["text"] for link in FROZEN}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("v=2", "version “2”"),
        ("v=too-long", "far too long"),
        ("v=1&preset=<script>alert(1)</script>", "no bearing"),
        ("v=1&extent_deg=nan", "not a number"),
        ("v=1&extent_deg=360.1", "length of the defect"),
        ("v=1&extent_deg=" + "1" * 5000, "not a number"),
        ("v=1&extent_deg=٣", "not a number"),
        ("v=1&fy_n=1e7", "out of range"),
        ("v=1&cage_angle_deg=361", "out of range"),
        ("v=1&seed=3&floor=rough", "not a number"),
        ("v=1&n_balls=1e300", "number of balls"),
        ("v=1&n_balls=400&ball_diameter_mm=0.1", "out of range"),
        ("v=1&defects=7", "1 to 6"),
        ("v=1&defects=²", "1 to 6"),
        ("v=1&selected=3", "selected"),
        ("v=1&defect2.depth_um=3", "is missing"),
        ("v=1&fy_n=1&fy_n=2", "twice"),
        ("v=1&dofs=x.x", "directions"),
        ("v=1&law=none", "not one of"),
        ("v=1&floor=soft", "no floor"),
        ("v=1&floor=measured&points=AAAA", "cannot be read"),
        ("v=1&floor=measured&points=%00", "cannot be read"),
        ("v=1&floor=measured&points=" + "A" * 1_000_000, "cannot be read"),
        ("v=1&" + "&".join(f"x{i}=1" for i in range(1000)), "far too many"),
        ("v=1&fy_n=" + "9" * 3_000_000, "too long"),
        ("v=1&" + "%" * 100_000, "ignored"),
        ("v=1&" + "%" * 2_000_000, "too many percent signs"),
        ("v=1&fy_n=%ff%fe", "not a number"),
        ("v=1&poisson=0.3", "Not possible"),
        ("v=1&__class__=1&tab=__init__", "ignored"),
    ],
    ids=lambda text: text[:40],
)  # fmt: skip
def test_strangers_get_the_bearing_to_begin_with_and_a_sentence(text: str, words: str) -> None:
    editor = SceneEditor("fan-rig")
    before = editor.snapshot()
    place = show_text(text, editor)
    assert words in place.note
    assert place.note.endswith(".")
    assert len(place.note) < 500
    assert editor.snapshot() == before
    assert place.scene == presets["fan-rig"]


def test_bombs_are_not_unpacked() -> None:
    text = base64.urlsafe_b64encode(zlib.compress(bytes(60_000_000), 9)).decode()
    assert len(text) < 500_000
    tracemalloc.start()
    try:
        with pytest.raises(ValueError, match="cannot be read"):
            unpack_points(text)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 4_000_000, "bytes held at once"


@settings(max_examples=120, deadline=None)
@given(st.one_of(st.text(), st.text("v=1&.%+-eSI0123456789defect", max_size=60)))
def test_anything_is_read_or_refused_in_a_sentence(text: str) -> None:
    for whole in (
        text,
        "v=1&" + text,
        "v=1&extent_deg=" + text,
        "v=1&floor=measured&points=" + text,
    ):
        editor = SceneEditor("fan-rig")
        note = show_text(whole, editor).note
        assert note == "" or note.endswith(".")  # fmt: skip


def test_a_link_without_a_version_is_read() -> None:
    place = show_text("?extent_deg=30&tab=stiffness", SceneEditor("fan-rig"))
    assert place.scene == presets["fan-rig"].replace(extent=math.radians(30))
    assert place.tab == "stiffness"
    assert place.note == ""


def test_a_link_that_cannot_be_read_still_opens_its_tab() -> None:
    place = show_text("v=1&extent_deg=400&tab=orbits", SceneEditor("fan-rig"))
    assert place.scene == presets["fan-rig"]
    assert place.tab == "over-speed"
    assert "length of the defect" in place.note


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", ""),
        ("?", ""),
        ("utm_source=x", "“utm_source”"),
        ("%ff=%ff", "“"),
        ("a=b&c", "“a” in the address, like 1 more,"),
        ("x" * 5000, "x…”"),
    ],
)
def test_what_is_not_known_in_an_address_is_said(text: str, named: str) -> None:
    assert read(text) is None
    note = show_text(text, SceneEditor("fan-rig")).note
    assert named in note
    assert len(note) < 200
    assert ("ignored." in note) == bool(named)
    place = show_text("v=1&extent_deg=30&fbclid=x1", SceneEditor("fan-rig"))
    assert place.scene.defect == dataclasses.replace(
        presets["fan-rig"].defect, extent=math.radians(30)
    )
    assert "fbclid" in place.note


def test_a_floor_too_long_for_a_link_is_left_out_and_said() -> None:
    n = 4000
    floor = MeasuredFloor(
        tuple(math.sin(0.5 * math.pi * (2 * i / (n - 1) - 1)) for i in range(n)),
        tuple(abs(math.sin(i * i)) for i in range(n)),
    )
    assert unpack_points(pack_points(floor)) == floor
    place = Place(presets["fan-rig"].replace(floor=floor, extent=0.3), "fan-rig")
    whole, link = write(place), write(place, LONGEST_LINK)
    assert read(whole) == place
    assert len(link) < 200
    assert leaves_out(link)
    assert not leaves_out(whole)
    shown = show_text(link, SceneEditor("fan-rig"))
    assert shown.scene == place.scene.replace(floor=None)
    assert "too long" in shown.note


@pytest.mark.parametrize(
    ("own", "words"),
    [
        ({"contact_angle": 0.7}, "_0_0.7"),
        ({"ball_diameter": 0.01, "outer_groove_radius": 0.0054}, "_0___0.01___0.0054"),
        ({"contact_angle": 0.7, "n_balls": 11, "pitch_diameter": 0.055}, "_0_0.7_11__0.055"),
    ],
)
def test_what_a_row_has_of_its_own_comes_back(own: dict[str, float], words: str) -> None:
    scene = presets["7208-back-to-back"]
    low, high = scene.bearing.rows
    rows = (low, dataclasses.replace(high, **own))  # type: ignore[arg-type]
    scene = scene.replace(bearing=scene.bearing.replace(rows=rows))
    text = write(Place(scene, "7208-back-to-back"))
    assert words in text
    place = read(text)
    assert place is not None
    assert place.scene == scene
    for wrong in (words + "_1_1_1_1_1_1", words.replace("_0_", "__", 1), words + "~0_1"):
        with pytest.raises(ValueError, match="rows of a bearing"):
            read(text.replace(words, wrong))
    with pytest.raises(ValueError, match="n_balls"):
        read(text.replace(words, "_0__11.5"))
