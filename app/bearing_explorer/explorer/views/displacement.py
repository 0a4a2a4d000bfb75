"""Displacement of the inner ring, and the stiffness at the operating point as a table to copy."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.side_by_side import (
    THIS_SCENE,
    Rows,
    scenes_of,
    side_by_side_html,
)
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.facts import LiveFacts, html_table, html_text
from bearingcore import DOF_NAMES
from bearingcore.common import ResultTable
from bearingcore.model.scene import DOF_SYMBOLS

_UNITS = tuple(("mrad", 1e3) if dof.startswith("r") else ("µm", 1e6) for dof in DOF_NAMES)
"""Unit of the displacement along each direction, and what one of SI is in it."""
_FACTORS = np.array([factor for _, factor in _UNITS])
_WAYS = (("to the left", "to the right"), ("down", "up"), ("back along z", "along z"))
_WHEN = ("at this cage angle", "least", "mean", "greatest")


class Displacement(View):
    """Displacement of the inner ring, now and over a period."""

    name = "displacement"
    title = "Displacement of the inner ring"
    about = (
        "How far the load moves the inner ring. It is measured from the middle of the outer ring; "
        "y counts upwards. Least, mean in time and greatest are those of one period, and with an "
        "inner-race defect of all turns of the shaft."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})
    in_report = False

    @property
    def compares(self) -> bool:
        return True

    def build(self, packed: PackedSource) -> Any:
        self._numbers = LiveFacts()
        return self._numbers

    def show(self, results: Results) -> None:
        compared = bool(results.compared)
        html = side_by_side_html(results, self.rows) if compared else self.html(results)
        self._numbers.put(text=html + self.more(results))

    def more(self, results: Results) -> str:
        """Tables of the scene alone, below."""
        return ""

    @staticmethod
    def rows(results: Results) -> Rows:
        """Its numbers one below the other, to stand beside those of other scenes."""
        for when, line in zip(_WHEN, displacements(results).tolist(), strict=True):
            for dof, (unit, _), value in zip(DOF_NAMES, _UNITS, line, strict=True):
                yield f"Displacement {DOF_SYMBOLS[dof]}, {when} ({unit})", _digits(value)

    def html(self, results: Results) -> str:
        """The table of a scene."""
        heads = (
            "",
            *(f"{DOF_SYMBOLS[d]} ({u})" for d, (u, _) in zip(DOF_NAMES, _UNITS, strict=True)),
        )
        moved = displacements(results)
        shown = [_without_noise(part, 5e-5) for part in (moved[:, :3], moved[:, 3:])]
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
        scenes = list(scenes_of(results))
        values = np.concatenate([displacements(one) for _, one in scenes])
        names = [
            f"{dof}_{'um' if unit == 'µm' else unit}"
            for dof, (unit, _) in zip(DOF_NAMES, _UNITS, strict=True)
        ]
        return {
            "scene": np.repeat([name or THIS_SCENE for name, _ in scenes], len(_WHEN)),
            "when": np.tile(_WHEN, len(scenes)),
            **dict(zip(names, values.T, strict=True)),
        }


class OperatingPoint(Displacement):
    """Displacement, and stiffness as five by five numbers to copy."""

    name = "operating-point"
    title = "Operating point"
    about = (
        "Displacement, and stiffness to copy, in N, m and rad. A row is a load on the inner ring, "
        "a column the displacement that it resists: at this cage angle, and the mean in time over "
        "a period, as rotor programs want it. "
        f"{reasons.STIFF_WHERE_HELD}"
    )

    @staticmethod
    def rows(results: Results) -> Rows:
        yield from Displacement.rows(results)
        for when, table in _stiffnesses(results):
            lines = _stiffness(table)
            for i, k in zip(*np.triu_indices(len(DOF_NAMES)), strict=True):
                name = "".join(DOF_SYMBOLS[DOF_NAMES[one]] for one in (i, k))
                yield f"Stiffness k<sub>{name}</sub>, {when}", _digits(float(lines[i, k]), 5)

    def more(self, results: Results) -> str:
        return "".join(_stiffness_html(*one) for one in _stiffnesses(results))

    def sentence(self, results: Results) -> str:
        state = results.ranges.state
        return state.sentence if state.converged.any() else super().sentence(results)

    def table(self, results: Results) -> dict[str, np.ndarray]:
        numbers: dict[str, list[Any]] = {"scene": [], "when": []}
        for name, one in scenes_of(results):
            over = one.ranges.state
            moved = over.displacement_table().named()["mean"], one.now.displacement[0]
            tables = over.stiffness_table(), one.now.stiffness_table(0)
            for when, displacement, table in zip(("mean", _WHEN[0]), moved, tables, strict=True):
                numbers["scene"] += len(DOF_NAMES) * [name or THIS_SCENE]
                numbers["when"] += len(DOF_NAMES) * [when]
                columns = table.named() | {"displacement_in_si": displacement}
                for column, values in columns.items():
                    numbers.setdefault(column, []).extend(values)
        return {column: np.array(values) for column, values in numbers.items()}


def _stiffnesses(results: Results) -> Iterable[tuple[str, ResultTable]]:
    yield _WHEN[0], results.now.stiffness_table(0)
    yield "mean in time", results.ranges.state.stiffness_table()


def _stiffness(table: ResultTable) -> np.ndarray:
    """(5, 5) without rounding noise."""
    _, *columns = table.named().values()
    return _without_noise(np.stack(columns, axis=1))


def _stiffness_html(when: str, table: ResultTable) -> str:
    rows = (
        (html_text(str(one)), *(_digits(float(value), 5) for value in line))
        for one, line in zip(table["load"], _stiffness(table), strict=True)
    )
    per = (f"{DOF_SYMBOLS[dof]} ({'rad' if dof.startswith('r') else 'm'})" for dof in DOF_NAMES)
    return f"<h3>Stiffness {when}</h3>{html_table(('', *per), rows, named=True)}"


def _without_noise(values: np.ndarray, least: float = 1e-9) -> np.ndarray:
    """Numbers below `least` of the largest one, noise or beyond its digits, as zero."""
    largest = np.nanmax(np.abs(values), initial=0.0)
    return np.where(np.abs(values) < least * largest, 0.0, values)


def displacements(results: Results) -> np.ndarray:
    """(4, 5) [µm, mrad] at this cage angle; least, mean and greatest over all positions."""
    over = results.ranges.state.displacement_table().named()
    rows = [results.now.displacement[0], *(over[when] for when in _WHEN[1:])]
    return _without_noise(np.array(rows, dtype=float) * _FACTORS)


def _digits(value: float, digits: int = 4) -> str:
    return "not known" if math.isnan(value) else style.number(value, digits)
