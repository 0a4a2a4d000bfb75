"""How many small wrong changes of the physics the quick tests notice.

    python -m tests.benchmarks.mutants --count 60 --seed 1 --work build/mutants --minutes 8

Each mutant is one change, drawn at random over the lines of the core's physics: a sign, a factor,
an exponent or a constant. It is put into a copy of the tree that stays as it is while mutants are
judged, with its own compiled code (made anew where a kernel changes, `kernels/compiling.py`).
Tests run until one fails, those likeliest to fail first: those that name the module, those of its
folder, those from outside, then all others that plain `pytest` runs without a browser. What is
found is kept, and the next call goes on from there.
"""

import argparse
import ast
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
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


def drawn(count: int, seed: int, tree: Path = ROOT) -> list[Mutant]:
    """So many mutants, drawn evenly over all changes of a tree."""
    mutants: list[Mutant] = []
    for folder in FOLDERS:
        for file in sorted((tree / "bearingcore" / folder).rglob("*.py")):
            if file.stem not in WORDS:
                mutants += mutants_of(file)
    return random.Random(seed).sample(mutants, count)


def stages(mutant: Mutant, tree: Path) -> Iterator[list[str]]:
    """Tests to run, the likeliest to fail first, each file once."""
    tests = tree / "tests"
    parts = mutant.file.relative_to(tree / "bearingcore").with_suffix("").parts
    names = re.compile(rf"\b{re.escape('.'.join(parts))}\b|\b{parts[0]} import .*\b{parts[-1]}\b")
    areas = [parts[0], *(("dynamics", "statics") if parts[0] == "kernels" else ())]
    done: set[Path] = set()
    for group in (
        [f for f in tests.rglob("test_*.py") if names.search(f.read_text("utf-8"))],
        [f for area in areas for f in (tests / "bearingcore" / area).rglob("test_*.py")],
        (tests / "outside").glob("test_*.py"),
        (tests / "bearingcore").rglob("test_*.py"),
        (tests / "bearing_explorer" / "explorer").rglob("test_*.py"),
        (tests / "bearing_explorer").rglob("test_*.py"),
        tests.glob("test_*.py"),
    ):
        new = {file for file in group if "browser" not in file.parts} - done
        done |= new
        if new:
            yield [str(file.relative_to(tree)) for file in sorted(new)]


def failing(mutant: Mutant, tree: Path, tests: list[str], most_seconds: float) -> str:
    """The first of these tests that fails with a mutant in place; "" where none does.

    Raises `subprocess.TimeoutExpired` where that takes longer.
    """
    whole = mutant.file.read_bytes()
    lines = whole.split(b"\n")
    line = lines[mutant.line - 1]
    lines[mutant.line - 1] = line[: mutant.begin] + mutant.new.encode() + line[mutant.end :]
    mutant.file.write_bytes(b"\n".join(lines))
    environment = {**os.environ, "PYTHONPATH": f"{tree}:{tree / 'app'}"}
    environment["NUMBA_CACHE_DIR"] = str(tree.parent / "numba")
    command = [sys.executable, "-m", "pytest", "-n", "0", "-x", "-q", "--no-header", *tests]
    try:
        run = subprocess.run(
            command, cwd=tree, env=environment, capture_output=True, text=True,
            timeout=most_seconds, check=False,
        )  # fmt: skip
    finally:
        mutant.file.write_bytes(whole)
    rows = [row for row in run.stdout.splitlines() if row.startswith(("FAILED", "ERROR"))]
    return "" if run.returncode in (0, 5) else rows[0] if rows else "did not start"


def said(mutant: Mutant, tree: Path) -> str:
    """Where a mutant is and what it changes."""
    old = mutant.file.read_bytes().split(b"\n")[mutant.line - 1][mutant.begin : mutant.end].decode()
    return f"{mutant.file.relative_to(tree)}:{mutant.line}:{mutant.begin} {old} → {mutant.new}"


def main() -> None:
    """Judge mutants until the time is over; print what is known of each."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--count", type=int, default=60)
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--work", type=Path, default=ROOT / "build" / "mutants")
    asked.add_argument("--minutes", type=float, default=1e3)
    asked.add_argument("--stages", type=int, default=7, help="so many groups of tests at most")
    given = asked.parse_args()
    # one that is ended from outside puts the tree right before it goes
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    tree, results = given.work / "tree", given.work / "results.json"
    if not tree.exists():
        left_out = shutil.ignore_patterns(".git", "__pycache__", "build")
        shutil.copytree(ROOT, tree, ignore=left_out)
    known = json.loads(results.read_text("utf-8")) if results.exists() else {}
    mutants = {said(mutant, tree): mutant for mutant in drawn(given.count, given.seed, tree)}
    end = time.monotonic() + 60.0 * given.minutes
    for stage in range(given.stages):
        for name, mutant in mutants.items():
            all_tests = list(stages(mutant, tree))
            kept = known.setdefault(name, {"passed": 0, "by": ""})
            if kept["by"] or kept["passed"] != stage or stage >= len(all_tests):
                continue
            left = end - time.monotonic()
            if left < 20.0:
                break
            try:
                kept["by"] = failing(mutant, tree, all_tests[stage], left)
            except subprocess.TimeoutExpired:
                break
            kept["passed"] += not kept["by"]
            kept["all"] = kept["passed"] == len(all_tests)
            results.write_text(json.dumps(known, indent=1, ensure_ascii=False), "utf-8")
    for i, name in enumerate(mutants, 1):
        kept = known[name]
        so_far = "NOT NOTICED" if kept.get("all") else f"{kept['passed']} groups of tests pass"
        print(f"{i:3} {name}: {kept['by'] or so_far}")
    print(f"{sum(bool(known[name]['by']) for name in mutants)} of {len(mutants)} noticed")


if __name__ == "__main__":
    main()
