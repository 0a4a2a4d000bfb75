"""Answers on measured records of real machines: stated against found, true against measured."""

from __future__ import annotations

import json
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from bokeh.models import Range1d, Scatter

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Glyph, Words, curve, draw, segments
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.widgets.form import row

STATED = style.AxisQuantity("Stated probability", "", "%")
FOUND = style.AxisQuantity("Found to be right", "", "%")
TRUE = style.AxisQuantity("True length", "", "°")
MEASURED = style.AxisQuantity("Measured length", "", "°")
SIZES = (340, 340)  # [px] heights

RELIABILITY = (
    curve("how_sure_ideal", "x", "y", style.FAINT_INK, 1.2, dash=(5, 4)),
    segments("how_sure_spread", style.DEFECTIVE, 2.0),
    Glyph(Scatter, "how_sure_bins", ("stated", "found"),
          {"size": 10, "fill_color": style.DEFECTIVE, "line_color": style.INK}),
    Words("how_sure_bins", "stated", "found",
          "return `${row.right} of ${row.count}`", ("right", "count"),
          look={"x_offset": -10, "text_align": "right"}),
)  # fmt: skip
EXTENTS = (
    curve("how_sure_same", "x", "y", style.FAINT_INK, 1.2, dash=(5, 4)),
    segments("how_sure_intervals", style.DEFECTIVE, 2.0),
    Glyph(Scatter, "how_sure_extents", ("true", "measured"),
          {"size": 8, "fill_color": style.DEFECTIVE, "line_color": style.INK}),
)  # fmt: skip

APART = 0.13
"""[°] between records of the same extent."""
NORMAL = 1.96
"""Deviations of a normal law that hold 95 %."""


@cache
def scoreboard() -> dict[str, Any]:
    """The answers on measured records, as the tests wrote them."""
    board: dict[str, Any] = json.loads(asset_text("scoreboard.json"))
    return board


def answers() -> list[dict[str, Any]]:
    """The records on which something was answered."""
    return [row for row in scoreboard()["records"] if row["verdict"] in ("right", "wrong")]


def reliability() -> dict[str, np.ndarray]:
    """Stated and found probability [%] of answers by what was stated, with Wilson's interval."""
    rows = []
    for low, high in pairwise(scoreboard()["bins"]):
        inside = [row for row in answers() if low <= row["probability"] < high]
        if not inside:
            continue
        count, right = len(inside), sum(row["verdict"] == "right" for row in inside)
        share, square = right / count, NORMAL**2 / count
        middle = (share + 0.5 * square) / (1.0 + square)
        reach = NORMAL * np.sqrt(share * (1.0 - share) / count + 0.25 * square / count)
        reach /= 1.0 + square
        stated = float(np.mean([row["probability"] for row in inside]))
        rows.append((stated, share, middle - reach, middle + reach, right, count))
    stated, found, low, high, right, count = np.array(rows, dtype=float).T
    return {
        "stated_percent": 100.0 * stated,
        "found_percent": 100.0 * found,
        "low_percent": 100.0 * low,
        "high_percent": 100.0 * high,
        "right": right,
        "count": count,
    }


def extents() -> dict[str, np.ndarray]:
    """True and measured extents [°] with their intervals, where both are known."""
    rows = [row for row in scoreboard()["records"] if row["true_extent_deg"] and "low_deg" in row]
    names = ("true_extent_deg", "extent_deg", "low_deg", "high_deg")
    return {name: np.array([row[name] for row in rows], dtype=float) for name in names}


class HowSure(View):
    """Answers of the diagnosis on records of real machines: how often they were right."""

    name = "how-sure"
    title = "How sure: answers on measured records of real machines"
    about = (
        "Stated probability against the share that was right. Second figure: true extents of "
        "spalls against those measured from entry to exit. Bars: intervals of 95 %. Dashed: as it "
        "should be. The records are public collections of a motor and three rigs. The "
        "diagnosis was fitted to these records and may do worse on other machines."
    )
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        left = style.make_figure(
            STATED,
            FOUND,
            Range1d(45.0, 102.0),
            Range1d(-3.0, 104.0),
            height=SIZES[0],
            sizing_mode="stretch_width",
        )
        draw(left, packed, RELIABILITY)
        top = 1.05 * float(np.max(extents()["high_deg"], initial=10.0))
        right = style.make_figure(
            TRUE,
            MEASURED,
            Range1d(0.0, top),
            Range1d(0.0, top),
            height=SIZES[1],
            sizing_mode="stretch_width",
        )
        draw(right, packed, EXTENTS)
        return row(left, right, stylesheets=[style.WRAPPED])

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        bins, sizes, ends = reliability(), extents(), np.array([0.0, 100.0])
        stated, true = bins["stated_percent"], _side_by_side(sizes["true_extent_deg"])
        return {
            "how_sure_ideal": {"x": ends, "y": ends},
            "how_sure_spread": _upright(stated, bins["low_percent"], bins["high_percent"]),
            "how_sure_bins": {
                "stated": stated, "found": bins["found_percent"],
                "right": bins["right"], "count": bins["count"],
            },
            "how_sure_same": {"x": ends, "y": ends},
            "how_sure_intervals": _upright(true, sizes["low_deg"], sizes["high_deg"]),
            "how_sure_extents": {"true": true, "measured": sizes["extent_deg"]},
        }, {}  # fmt: skip

    def sentence(self, model: Model) -> str:
        rows, told = scoreboard()["records"], answers()
        right = sum(row["verdict"] == "right" for row in told)
        sure = [row for row in told if row["probability"] >= 0.9]
        kept = sum(row["verdict"] == "right" for row in sure)
        sizes = extents()
        held = (sizes["low_deg"] <= sizes["true_extent_deg"]) & (
            sizes["true_extent_deg"] <= sizes["high_deg"]
        )
        return (
            f"Of {len(rows)} records {len(told)} were answered, {right} of them correctly; of "
            f"{len(sure)} answers stated with 90 % or more {kept} were right. {int(held.sum())} of "
            f"{len(held)} measured extents have the true one in their interval."
        )

    def table(self, model: Model) -> dict[str, np.ndarray]:
        return reliability()


def _side_by_side(places: np.ndarray) -> np.ndarray:
    """Equal places set apart a little."""
    apart = places.copy()
    for place in np.unique(places):
        same = places == place
        apart[same] += APART * (np.arange(same.sum()) - 0.5 * (same.sum() - 1))
    return apart


def _upright(place: np.ndarray, low: np.ndarray, high: np.ndarray) -> dict[str, np.ndarray]:
    return {"x0": place, "y0": low, "x1": place, "y1": high}
