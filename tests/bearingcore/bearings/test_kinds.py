"""Kinds of bearing: stored, recognized in files that do not name them, and asked for as data."""

import dataclasses
import pickle

import pytest

from bearingcore import presets
from bearingcore.bearings import KINDS, convert_bearing

every_preset = pytest.mark.parametrize("name", list(presets))


@every_preset
def test_a_kind_is_recognized_in_files_without_its_name(name: str) -> None:
    bearing = presets[name].bearing
    assert "kind" not in presets[name].to_data()["bearing"]
    assert dataclasses.replace(bearing, kind=bearing.kind.name) == bearing
    assert pickle.loads(pickle.dumps(bearing)).kind is bearing.kind


@every_preset
def test_each_variant_is_made_of_any_bearing(name: str) -> None:
    for kind in KINDS.values():
        for variant in kind.variants:
            made = convert_bearing(presets[name].bearing, variant.name)
            assert made.kind is kind
            assert kind.variant(made) == variant.name
