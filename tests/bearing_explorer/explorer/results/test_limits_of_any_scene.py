"""The limits of whatever scene can be typed: known or not known, and never an error."""

import random

import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor

from bearingcore import presets
from tests.fuzz.hostile_messages import quantities

SCENES = 400


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.proof
def test_limits_of_any_scene_are_numbers_or_not_known() -> None:
    chance = random.Random("limits")
    for _ in range(SCENES):
        editor = SceneEditor(chance.choice(list(presets)))
        for _ in range(chance.choice((1, 2, 3, 6))):
            editor.set(quantities(chance))
        limits = Results(editor.scene, 0.1).limits
        assert limits
        assert all(limit.sentence for limit in limits)
