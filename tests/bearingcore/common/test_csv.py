"""Tables as files."""

import csv
import io

import numpy as np
import pytest

from bearingcore.common.table import as_csv


def test_columns_of_different_length_end_in_empty_cells() -> None:
    table = {
        "cage_angle_deg": np.array([0.0, 0.1 + 0.2]),
        "label": np.array(["x1"]),
        "k_yy_n_per_m": np.array([1.25e8, np.nan]),
    }
    assert as_csv(table) == ("cage_angle_deg,label,k_yy_n_per_m\n0,x1,125000000\n0.3,,nan\n")


def test_an_empty_table_is_its_head() -> None:
    assert as_csv({"time_s": np.array([])}) == "time_s\n"


@pytest.mark.parametrize("word", ["=cmd|'/C calc'!A0", "+1", "-1", "@SUM(A1)", "\t=1"])
def test_words_are_no_formulas_to_a_spreadsheet(word: str) -> None:
    text = as_csv({word: np.array([-1.5]), "name": np.array([word])})
    head, row = csv.reader(io.StringIO(text, newline=""))
    assert head == ["'" + word, "name"]
    assert row == ["-1.5", "'" + word]
