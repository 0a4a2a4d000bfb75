"""What the packed source packs, and what it refuses."""

import numpy as np
import pytest
from bearing_explorer.kit.serve.packed_source import PackedSource


def packed_source() -> PackedSource:
    made = PackedSource()
    made.source("a", "x", "y")
    made.source("b", "z")
    made.range("r", 0, 1)
    return made


def test_the_packet_says_what_it_holds() -> None:
    packed = packed_source().pack(
        {"b": {"z": [1, np.nan]}, "a": {"y": [3], "x": [2]}}, {"r": (5, 6)}, 7, 0.25
    )
    head = [7, 0.25, 2, 1, 1, 1, 2, 0, 2, 1, 0, 5, 6]
    np.testing.assert_array_equal(packed, np.float32([*head, 1, np.nan, 2, 3]))
    assert packed.dtype == np.float32


def test_what_did_not_change_is_not_sent_again() -> None:
    made = packed_source()
    first = {"a": {"x": [1, np.nan], "y": [0, 0]}, "b": {"z": [1]}}
    made.pack(first, {"r": (0, 2)})
    np.testing.assert_array_equal(made.pack(first, {"r": (0, 2)}, 1), [1, 0, 0, 0])
    first["b"]["z"] = [2]
    np.testing.assert_array_equal(made.pack(first, {"r": (0, 2)}, 2), [2, 0, 1, 0, 1, 1, 1, 2])


@pytest.mark.parametrize(
    ("data", "ranges", "message"),
    [
        ({"c": {"x": [1]}}, {}, "'c' was not declared"),
        ({}, {"s": (0, 1)}, "'s' was not declared"),
        ({"a": {"x": [1]}}, {}, "'a' has columns"),
        ({"a": {"x": [1], "y": [1, 2]}}, {}, "differ in length"),
    ],
)
def test_what_the_browser_could_not_place_is_refused(data, ranges, message) -> None:
    with pytest.raises(ValueError, match=message):
        packed_source().pack(data, ranges)


def test_names_are_one_per_session() -> None:
    made = packed_source()
    with pytest.raises(ValueError, match="declared twice"):
        made.source("a", "x")
    with pytest.raises(ValueError, match="declared twice"):
        made.range("r", 0, 1)
    with pytest.raises(ValueError, match="no columns"):
        made.source("c")
