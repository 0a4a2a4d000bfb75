"""Measure speed against accuracy for the page and the documents.

    python -m tests.benchmarks.charts --ship [--preset NAME ...]
    python -m tests.benchmarks.charts            # only writes the documents anew

`--ship` runs every experiment of `bearingcore.model.experiments._measurements` on presets, all
unless some are named, and writes a file for each to assets/accuracy as soon as it is measured: two
to five minutes a preset on a quiet machine. What a scene cannot have is kept in its file with the
reason, and printed. Then the tables of assets/docs/ACCURACY.md are written from the files.
"""

import argparse
import json
import math
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bearing_explorer.explorer.views.work_precision import ALLOWED

from bearingcore import presets
from bearingcore.common import number, scientific, with_prefix
from bearingcore.model.experiments import (
    Experiment,
    Measurements,
    Point,
    measure,
    measurements_from,
)
from tests.benchmarks.machine import pace

ASSETS = Path(__file__).parents[2] / "assets"
FILES = ASSETS / "accuracy"
DOCUMENT = ASSETS / "docs" / "ACCURACY.md"
BEGIN, END = "<!-- tables of {} begin -->", "<!-- tables of {} end -->"
IN_DOCUMENT = ("fan-rig", "liew-lim")


def ship(preset: str) -> None:
    """Measure a preset and write its file."""
    began = time.perf_counter()
    results = measure(presets[preset], c_loop=pace().motion)
    FILES.mkdir(exist_ok=True)
    (FILES / f"{preset}.json").write_text(as_json(results), encoding="utf-8")
    print(f"{preset}: {results.count} points in {time.perf_counter() - began:.0f} s; {pace()}")
    for name, why in results.refused.items():
        print(f"  no {name}: {why}", flush=True)


_AS_USUAL = (("status", "right"), ("against", ""), ("in_use", False))
"""Entries of points that files leave out."""


def as_json(results: Measurements) -> str:
    """The text of a file: numbers with four digits, an experiment to a line."""
    parts = _rounded(asdict(results))
    experiments = ",\n".join(
        f"{json.dumps(name)}: {json.dumps(experiment, ensure_ascii=False)}"
        for name, experiment in parts.pop("experiments").items()
    )
    rest = json.dumps(parts, ensure_ascii=False)
    return f'{rest[:-1]},\n"experiments": {{\n{experiments}\n}}}}\n'


def _rounded(value: Any) -> Any:
    if isinstance(value, float) and not value.is_integer():
        return float(f"{value:.4g}")
    if isinstance(value, dict):
        return {n: _rounded(item) for n, item in value.items() if (n, item) not in _AS_USUAL}
    return [_rounded(item) for item in value] if isinstance(value, list | tuple) else value


def tables(results: Measurements) -> str:
    """Every experiment as Markdown: a table for each reference, a row for each method."""
    parts = [results.machine.sentence]
    for name, experiment in results.experiments.items():
        parts += [
            f"### {name}: against {case or 'the reference'}\n\n{_table(part)}"
            for case, part in experiment.per_reference().items()
            if part.points
        ]
    return "\n\n".join(parts)


def _table(one: Experiment) -> str:
    (reference,) = one.references.values()
    error = next(iter(one.errors))
    rows = [["method", "setting", f"error of {error}", "time", one.evaluations]]
    rows += [["---", "---", "---:", "---:", "---:"]]
    own = [point for method in one.methods for point in _row_of(one.of(method), one, error)]
    for point in (p for p in one.points if any(p is known for known in own)):
        cell = _error(point.errors.get(error, math.nan), one.unit(error))
        seconds = with_prefix(point.seconds, "s") if math.isfinite(point.seconds) else ""
        method = f"**{point.method}**" if point.in_use else point.method
        cell = point.status if point.failed else cell
        rows.append([method, point.setting, cell, seconds, number(point.evaluations, 4)])
    lines = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    apart = ", ".join(f"{name} {scientific(v, 2)}" for name, v in reference.agreement.items())
    verdict = "agree" if reference.trusted else "DO NOT AGREE, so errors below mean little"
    words = f"{' and '.join(reference.families)} {verdict}: apart by {apart}"
    words += f". {reference.note}" if reference.note else ""
    return f"{words}.\n\n{lines}"


def _row_of(points: tuple[Point, ...], experiment: Experiment, error: str) -> list[Point]:
    """The first point of a method within the allowed error or else its best, and what is in use."""
    good = [p for p in points if not p.failed and not math.isnan(p.errors.get(error, math.nan))]
    within = [p for p in good if p.errors[error] <= ALLOWED[experiment.unit(error)]]
    best = within[:1] or sorted(good, key=lambda p: p.errors[error])[:1] or list(points[:1])
    return [*best, *(p for p in points if p.in_use)]


def _error(error: float, unit: str) -> str:
    if not math.isfinite(error):
        return "none" if math.isnan(error) else "∞"
    text = number(error, 2) if 0.01 <= error < 1000.0 else scientific(error, 2)
    return f"{text} dB" if unit == "dB" else text


def document(text: str) -> str:
    """The document with the tables of the files in it."""
    for preset in IN_DOCUMENT:
        results = measurements_from((FILES / f"{preset}.json").read_text(encoding="utf-8"))
        text = put(text, preset, tables(results))
    return text


def put(text: str, name: str, tables: str) -> str:
    """A document with its tables of that name replaced."""
    begin, end = BEGIN.format(name), END.format(name)
    before, _, rest = text.partition(begin)
    _, _, after = rest.partition(end)
    return f"{before}{begin}\n\n{tables}\n\n{end}{after}"


def main() -> None:
    """Measure where that is wanted, and write the document."""
    parser = argparse.ArgumentParser(description="Speed against accuracy, measured.")
    parser.add_argument("--ship", action="store_true", help="measure and write the files")
    parser.add_argument("--preset", nargs="+", choices=[*presets], default=[*presets])
    given = parser.parse_args()
    for preset in given.preset if given.ship else ():
        ship(preset)
    DOCUMENT.write_text(document(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
