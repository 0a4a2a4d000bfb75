"""How many small wrong changes of the physics the quick tests notice.

    python -m tests.benchmarks.mutants --count 60 --seed 1

Each mutant is one change, drawn at random over the lines of the core's physics, in a copy of the
tree: a sign, a factor, an exponent or a constant. Tests from outside run first, then those of the
folder that was changed, until one fails.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
FOLDERS = ("bearings", "scene", "kernels", "statics", "dynamics")
WORDS = ("designation", "designation_tables", "catalogue", "suffix", "presets")
"""Files of tables and words, not of physics."""

OPPOSITE = {ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*"}


class Mutant(NamedTuple):
    """A change: file, line (from 1), columns from and to, and what is put there."""

    file: Path
    line: int
    begin: int
    end: int
    new: str


def mutants_of(file: Path) -> Iterator[Mutant]:
    """All changes of one file: operators swapped, floating-point constants a twentieth greater."""
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.BinOp) and type(node.op) in OPPOSITE:
            left, right = node.left, node.right
            if left.end_lineno != right.lineno or isinstance(left, ast.Constant | ast.JoinedStr):
                continue
            raw = lines[right.lineno - 1].encode()
            between = raw[left.end_col_offset or 0 : right.col_offset].decode()
            old = {"-": "+", "+": "-", "/": "*", "*": "/"}[OPPOSITE[type(node.op)]]
            if between.strip() == old:
                at = (left.end_col_offset or 0) + between.index(old)
                yield Mutant(file, right.lineno, at, at + 1, OPPOSITE[type(node.op)])
        elif isinstance(node, ast.Constant) and isinstance(node.value, float) and node.value:
            new = repr(1.05 * node.value)
            yield Mutant(file, node.lineno, node.col_offset, node.end_col_offset or 0, new)


def drawn(count: int, seed: int) -> list[Mutant]:
    """So many mutants, drawn evenly over all changes."""
    found: list[Mutant] = []
    for folder in FOLDERS:
        for file in sorted((ROOT / "bearingcore" / folder).rglob("*.py")):
            if file.stem not in WORDS:
                found += mutants_of(file)
    return random.Random(seed).sample(found, count)


TOO_LONG = "not known: took too long"


def noticed(one: Mutant, copy: Path, most_seconds: float, first: list[str]) -> str:
    """The first test that fails; "" where none does, TOO_LONG where that is not known."""
    place = copy / one.file.relative_to(ROOT)
    whole = place.read_bytes()
    lines = whole.split(b"\n")
    line = lines[one.line - 1]
    lines[one.line - 1] = line[: one.begin] + one.new.encode() + line[one.end :]
    place.write_bytes(b"\n".join(lines))
    folder = one.file.relative_to(ROOT / "bearingcore").parts[0]
    environment = {**os.environ, "PYTHONPATH": f"{copy}:{copy / 'app'}"}
    try:
        for tests in (first, [f"tests/bearingcore/{folder}"]):
            run = subprocess.run(
                [sys.executable, "-m", "pytest", "-n", "0", "-x", "-q", "--no-header", *tests],
                cwd=copy, env=environment, capture_output=True, text=True, timeout=most_seconds,
                check=False,
            )  # fmt: skip
            failed = [row for row in run.stdout.splitlines() if row.startswith(("FAILED", "ERROR"))]
            if run.returncode not in (0, 5):
                return failed[0] if failed else "did not start"
    except subprocess.TimeoutExpired:
        return TOO_LONG
    finally:
        place.write_bytes(whole)
    return ""


def main() -> None:
    """Print a row a mutant, and how many were noticed."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--count", type=int, default=60)
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--most-seconds", type=float, default=600.0)
    asked.add_argument("--first", nargs="+", default=["tests/outside"])
    given = asked.parse_args()
    right = unknown = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "tree"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", "__pycache__"))
        for i, one in enumerate(drawn(given.count, given.seed), 1):
            began = time.perf_counter()
            by = noticed(one, copy, given.most_seconds, given.first)
            unknown += by == TOO_LONG
            right += bool(by) and by != TOO_LONG
            text = one.file.read_text(encoding="utf-8").splitlines()[one.line - 1]
            old = text.encode()[one.begin : one.end].decode()
            where = f"{one.file.relative_to(ROOT)}:{one.line}"
            took = time.perf_counter() - began
            print(
                f"{i:3} {where} {old} → {one.new} {took:.0f} s: {by or 'NOT NOTICED'}", flush=True
            )
    print(f"{right} of {given.count} noticed, {unknown} not known")


if __name__ == "__main__":
    main()
