"""Tables of numbers to read."""

import re

import numpy as np
from bearing_explorer.kit.widgets.facts import table_to_read


def cells(table: str, tag: str) -> list[str]:
    return re.findall(rf"<{tag}[^>]*>([^<]*)</{tag}>", table)


def test_a_table_has_words_units_and_six_digits() -> None:
    table, count = table_to_read(
        {
            "cage_angle_deg": np.array([0.0, 1.0 / 3.0]),
            "k_yy_n_per_m": np.array([-12345678.9, np.nan]),
            "k_xy_n_per_m": np.array([2.5e-10, -7.4e-9]),  # rounding noise
            "k_ry_n_per_rad": np.array([2.5e-10, np.inf]),
            "n_loaded": np.array([4, 5]),
            "word": np.array(["<b>", "good"]),
        }
    )
    others = ["k xy (N/m)", "k ry (N/rad)"]
    assert cells(table, "th") == ["cage angle (°)", "k yy (N/m)", *others, "n loaded", "word"]
    assert cells(table, "td") == [
        *("0", "−1.23457·10⁷", "0", "2.5·10⁻¹⁰", "4", "&lt;b&gt;"),
        *("0.333333", "no value", "0", "no value", "5", "good"),
    ]
    assert count == "2 rows"


def test_a_long_table_begins_where_there_is_something() -> None:
    pulse = np.zeros(1000)
    pulse[700:] = 5.0
    table, count = table_to_read({"time_s": np.arange(1000.0), "load_n": pulse, "short": pulse[:2]})
    assert (
        count == "Rows 700 to 999 of 1000; before them all values are zero; the CSV file has all."
    )
    assert cells(table, "td")[:6] == ["699", "0", "", "700", "5", ""]
