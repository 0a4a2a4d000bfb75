"""The line under the page: how the newest answer went."""

import pytest
from bearing_explorer.compute.results import Results
from bearing_explorer.widgets.status import scientific, status_of

from bearingcore import presets


def test_the_status_line_says_what_happened() -> None:
    good = status_of(Results(presets["fan-rig"]), 0.0123)
    assert (good["mood"], good["words"]) == ("good", "Converged")
    assert good["details"][1:] == [
        "2 degrees of freedom: x y",
        "121 cage angles",
        "12.3 ms of computing",
    ]
    assert "residual at most" in good["details"][0]
    bad = status_of(Results(presets["fan-rig"].replace(fy=0.0)), 0.001)
    assert bad["mood"] == "bad"
    assert "nothing touches" in bad["words"]


@pytest.mark.parametrize(
    ("value", "text"), [(0.0, "0"), (3.2e-12, "3·10⁻¹²"), (1e-6, "1·10⁻⁶"), (4e3, "4·10³")]
)
def test_small_numbers_are_written_as_people_write_them(value: float, text: str) -> None:
    assert scientific(value) == text
