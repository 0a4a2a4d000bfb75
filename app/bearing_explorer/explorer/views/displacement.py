"""Displacement of the inner ring, and the stiffness at the operating point as a table to copy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.facts import LiveFacts, html_table, html_text
from bearingcore import DOF_NAMES
from bearingcore.common import ResultTable
from bearingcore.model.scene import DOF_SYMBOLS

_UNITS = tuple(("mrad", 1e3) if dof.startswith("r") else ("µm", 1e6) for dof in DOF_NAMES)
"""Unit of the displacement along each direction, and the factor from SI to it."""
_FACTORS = np.array([factor for _, factor in _UNITS])
_WAYS = (("to the left", "to the right"), ("down", "up"), ("back along z", "along z"))
_WHEN = ("at this cage angle", "least", "mean", "greatest")


class Displacement(View):
    """Displacement of the inner ring, at this cage angle and over a period."""

    name = "displacement"
    title = "Displacement of the inner ring"
    about = (
        "How far the load moves the inner ring. It is measured from the middle of the outer ring; "
        "y counts upwards. Least, mean in time and greatest are over one period; for an inner-race "
        "defect, over all turns of the shaft."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})

    def build(self, packed: PackedSource) -> Any:
        self._numbers = LiveFacts()
        return self._numbers

    def show(self, results: Results) -> None:
        self._numbers.put(text=self.html(results))

    def html(self, results: Results) -> str:
        """The numbers as tables."""
        heads = (
            "",
            *(f"{DOF_SYMBOLS[d]} ({u})" for d, (u, _) in zip(DOF_NAMES, _UNITS, strict=True)),
        )
        moved = displacements(results)
        shown = [_drop_noise(part, 5e-5) for part in (moved[:, :3], moved[:, 3:])]
        rows = (
            (html_text(when), *(_digits(value) for value in line))
            for when, line in zip(_WHEN, np.hstack(shown).tolist(), strict=True)
        )
        return html_table(heads, rows, named=True)

    def sentence(self, results: Results) -> str:
        if not results.now.converged[0]:
            return f"No displacement: {results.now.reason(0)}."
        now = results.now.displacement[0] * _FACTORS
        moved = [
            f"{style.number(abs(value))} µm {way[value > 0.0]}"
            for value, way in zip(now[:3].tolist(), _WAYS, strict=True)
            if abs(value) > 0.01 * np.abs(now[:3]).max()
        ]
        tilt = math.hypot(*now[3:])
        words = (
            f"The inner ring is moved by {style.list_words(moved)}"
            if moved
            else "The inner ring is in the middle"
        )
        if tilt >= 5e-7:
            words += f", and tilted by {style.number(tilt)} mrad"
        return f"{words}. {results.scene.tilt_words()}".rstrip()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        names = [
            f"{dof}_{'um' if unit == 'µm' else unit}"
            for dof, (unit, _) in zip(DOF_NAMES, _UNITS, strict=True)
        ]
        return {
            "when": np.array(_WHEN),
            **dict(zip(names, displacements(results).T, strict=True)),
        }


class OperatingPoint(Displacement):
    """Displacement of the inner ring, and the 5×5 stiffness matrix to copy."""

    name = "operating-point"
    title = "Operating point"
    about = (
        "Displacement, and stiffness to copy, in N, m and rad. A row is a load on the inner ring, "
        "a column the displacement that it resists. The values are those at this cage angle, and "
        "the mean in time over a period, which rotor programs need. "
        f"{reasons.STIFF_WHERE_HELD}"
    )

    def html(self, results: Results) -> str:
        now = _stiffness_html(_WHEN[0], results.now.stiffness_table(0))
        mean = _stiffness_html("mean in time", results.ranges.state.stiffness_table())
        return super().html(results) + now + mean

    def sentence(self, results: Results) -> str:
        state = results.ranges.state
        return state.sentence if state.converged.any() else super().sentence(results)

    def table(self, results: Results) -> dict[str, np.ndarray]:
        ranges = results.ranges.state
        mean = ranges.stiffness_table().named()
        now = results.now.stiffness_table(0).named()
        moved = ranges.displacement_table().named()["mean"], results.now.displacement[0]
        return {
            "when": np.repeat(["mean", _WHEN[0]], len(DOF_NAMES)),
            **{column: np.append(mean[column], now[column]) for column in mean},
            "displacement_in_si": np.concatenate(moved),
        }


def _stiffness_html(when: str, table: ResultTable) -> str:
    """A stiffness matrix as an HTML table; `when` is part of its heading."""
    _, *columns = table.named().values()
    rows = (
        (html_text(str(load)), *(_digits(float(value), 5) for value in line))
        for load, line in zip(table["load"], _drop_noise(np.stack(columns, axis=1)), strict=True)
    )
    per = (f"{DOF_SYMBOLS[dof]} ({'rad' if dof.startswith('r') else 'm'})" for dof in DOF_NAMES)
    return f"<h3>Stiffness {when}</h3>{html_table(('', *per), rows, named=True)}"


def _drop_noise(values: np.ndarray, least: float = 1e-9) -> np.ndarray:
    """Replace numbers below `least` times the largest one by zero: they are noise."""
    largest = np.nanmax(np.abs(values), initial=0.0)
    return np.where(np.abs(values) < least * largest, 0.0, values)


def displacements(results: Results) -> np.ndarray:
    """Displacements (4, 5) [µm, mrad]: at this cage angle; least, mean, greatest of a period."""
    ranges = results.ranges.state.displacement_table().named()
    rows = [results.now.displacement[0], *(ranges[when] for when in _WHEN[1:])]
    return _drop_noise(np.array(rows, dtype=float) * _FACTORS)


def _digits(value: float, digits: int = 4) -> str:
    return "not known" if math.isnan(value) else style.number(value, digits)
