"""The same work by programs of other people, in the same run: time and difference.

    python -m tests.benchmarks.peers --iso16281 FOLDER    # writes a table of ACCURACY.md

FOLDER is a checkout of github.com/minzhun/ISO16281. ROSS (`ross-rotordynamics`) and EXUDYN
(`exudyn`) come from PyPI, best into an environment of their own; none of them is needed by anything
else. EXUDYN integrates the motion with the compiled equations of `tests/outside/march.py`;
the truth is DOP853 at 1e-12 on these. Times are those of the processor, as others may use it too.
"""

import argparse
import contextlib
import importlib
import io
import itertools
import math
import sys
import time
from collections.abc import Callable, Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import Load, Scene, equilibrium, life, presets, simulate, warm
from bearingcore.common import number, scientific, with_prefix
from tests.benchmarks.charts import DOCUMENT, put
from tests.outside.march import rates
from tests.outside.test_charts import problem

MARK = "peers"
DURATION, RATE = 0.1, 65_536.0
INSTANTS = np.arange(round(DURATION * RATE)) / RATE
ISO_CHECKOUT = "ade7076"
"""What of minzhun/ISO16281 the table was made with."""


class Row(NamedTuple):
    """A line of the table: times [s]; difference from ours, or of motions from the truth."""

    work: str
    program: str
    seconds: float
    own_seconds: float
    difference: float
    of: str


def processor_time(work: Callable[[], Any]) -> tuple[Any, float]:
    """What a work gives once it is warm, and the least processor time [s] of some runs."""
    work()
    least, spent = math.inf, 0.0
    while spent < 0.5:
        begin = time.process_time()
        answer = work()
        taken = time.process_time() - begin
        least, spent = min(least, taken), spent + max(taken, 0.01)
    return answer, least


def apart(ours: float, own: float) -> float:
    """Relative difference."""
    return abs(ours / own - 1.0)


def compare_iso_16281(folder: Path) -> Iterator[Row]:
    """Loads of seven balls with 10 µm of clearance and their life, and 14 rollers with 30 µm."""
    sys.path.insert(0, str(folder))
    balls, rollers, head = (
        importlib.import_module(name) for name in ("BallBearing", "RollerBearing", "Head")
    )
    steel = head.Material("Steel", 210000.0, 0.3)
    program = f"minzhun/ISO16281 {ISO_CHECKOUT}"

    def seven() -> Any:
        with contextlib.redirect_stdout(io.StringIO()):
            bearing = balls.BallBearing(1, 7, 11.5, 43.5, 0.0, 0.0, 1)
            bearing.geometry(0.01)
            bearing.stiffness(steel)
            bearing.disp(head.Load(1000.0, 0.0, 1000.0, 0.0, 0.0, 0.0))
            bearing.rating(head.BasicCapacity(23400.0))
        return bearing

    scene = presets["seven-ball"].healthy()
    scene = scene.replace(radial_clearance=5e-6, load=Load(fx=1000.0, fz=1000.0), dofs="tilt free")
    theirs, seconds = processor_time(seven)
    loads = itertools.count(1000.0, 1e-9)  # each another scene: lives are kept
    own, own_seconds = processor_time(lambda: life(scene.replace(fx=next(loads)), 23400.0))
    rest = equilibrium(scene, [0.0])
    work = "seven balls under 1 kN across and 1 kN along the shaft: equilibrium and life"
    shift = apart(1e-3 * theirs.Delta_r, rest.displacement[0, 0])
    yield Row(work, program, seconds, own_seconds, shift, "displacement")
    lasts = apart(theirs.L10r, own.million_revolutions)
    yield Row("", program, seconds, own_seconds, lasts, "L_10r")

    def fourteen() -> Any:
        bearing = nu208.bearing
        with contextlib.redirect_stdout(io.StringIO()):
            one = rollers.RollerBearing(
                1, 14, 1e3 * bearing.ball_diameter, 1e3 * bearing.pitch_diameter,
                1e3 * bearing.roller_length, 0.0, 0.0, 1,
            )  # fmt: skip
            one.geometry(2e3 * bearing.radial_clearance)
            one.stiffness(steel)
            one.disp(head.Load(3000.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        return one

    nu208 = presets["nu208"].healthy().replace(load=Load(fx=3000.0))
    theirs, seconds = processor_time(fourteen)
    rest, own_seconds = processor_time(lambda: equilibrium(nu208, [0.0]))
    shift = apart(1e-3 * theirs.Delta_r, rest.displacement[0, 0])
    work = "14 rollers under 3 kN: equilibrium"
    yield Row(work, program, seconds, own_seconds, shift, "displacement")


def compare_ross() -> Iterator[Row]:
    """Stiffness of ROSS's own test case: 8 balls of 30 mm at 30° under 500 N, one ball below."""
    import ross

    theirs, seconds = processor_time(
        lambda: ross.BallBearingElement(0, 8, 0.03, 500.0, math.pi / 6)
    )
    scene: Scene = presets["fan-rig"].healthy()
    scene = scene.replace(load=Load(fy=-500.0)).replace(
        n_balls=8, ball_diameter=0.03, contact_angle=math.pi / 6, radial_clearance=0.0,
        load_deflection_factor=4.36e-8**-1.5 * math.sqrt(0.03), pitch_diameter=0.6,
        groove_center_distance=0.024, dofs=("x", "y"),
    )  # fmt: skip
    rest, own_seconds = processor_time(lambda: equilibrium(scene, [0.0]))
    work = "8 balls of 30 mm at 30° under 500 N, no clearance: stiffness"
    program = f"ROSS {version('ross-rotordynamics')}"
    for term, name in (("k_yy", "kyy"), ("k_xx", "kxx")):
        number = float(np.ravel(getattr(theirs, name))[0])
        difference = apart(number, rest.term(term)[0])
        yield Row(work, program, seconds, own_seconds, difference, term)
        work = ""


def swings(housing: NDArray[np.float64], true: NDArray[np.float64]) -> float:
    """Error of the housing's displacement over its swing, L2."""
    swing = true - true.mean(axis=0)
    return math.sqrt(np.sum((housing - true) ** 2) / np.sum(swing**2))


def compare_multibody() -> Iterator[Row]:
    """0.1 s of the fan rig from rest."""
    import exudyn
    from exudyn.itemInterface import NodeGenericODE2, ObjectGenericODE2, SensorNode

    rig, one = presets["fan-rig"], problem("fan-rig")
    motion, own_seconds = processor_time(lambda: simulate(rig, DURATION, RATE).outer_displacement)
    start, packed = one.start(), one.packed()
    true = one.solved(start, INSTANTS, 1e-12)[:, 2:4]
    own = swings(1e6 * motion, true)
    work = "0.1 s of the fan rig's motion"
    yield Row(work, "here", own_seconds, own_seconds, own, "housing's displacement")

    def push(
        mbs: Any, t: float, item: int, q: NDArray[np.float64], v: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        return rates(t, np.concatenate([np.asarray(q), np.asarray(v)]), *packed)[4:]

    def multibody(solver: Any, steps: int) -> NDArray[np.float64]:
        system = exudyn.SystemContainer()
        mbs = system.AddSystem()
        node = mbs.AddNode(
            NodeGenericODE2(
                numberOfODE2Coordinates=4, referenceCoordinates=[0.0] * 4,
                initialCoordinates=list(start[:4]), initialCoordinates_t=[0.0] * 4,
            )
        )  # fmt: skip
        mbs.AddObject(
            ObjectGenericODE2(nodeNumbers=[node], massMatrix=np.eye(4), forceUserFunction=push)
        )
        sensor = mbs.AddSensor(
            SensorNode(
                nodeNumber=node, storeInternal=True,
                outputVariableType=exudyn.OutputVariableType.Coordinates,
            )
        )  # fmt: skip
        mbs.Assemble()
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.endTime = float(INSTANTS[-1])
        settings.timeIntegration.numberOfSteps = steps * (len(INSTANTS) - 1)
        settings.solutionSettings.writeSolutionToFile = False
        settings.solutionSettings.sensorsWritePeriod = 1.0 / RATE
        settings.timeIntegration.verboseMode = 0
        mbs.SolveDynamic(settings, solverType=solver)
        return np.asarray(mbs.GetSensorStoredData(sensor))[:, 3:5]

    kinds = exudyn.DynamicSolverType
    program = f"EXUDYN {version('exudyn')}"
    for name, solver, steps in (
        ("RK44", kinds.RK44, 1),
        ("generalised α", kinds.GeneralizedAlpha, 1),
    ):
        trace, seconds = processor_time(lambda solver=solver, steps=steps: multibody(solver, steps))
        difference = swings(trace[: len(true)], true)
        yield Row("", f"{program}, {name}", seconds, own_seconds, difference, "the same")


def table(rows: list[Row]) -> str:
    """Rows as Markdown."""
    head = ["work", "program", "its processor time", "here", "times ours", "difference"]
    lines = [head, ["---", "---", "---:", "---:", "---:", "---:"]]
    for row in rows:
        ratio = "" if row.program == "here" else number(row.seconds / row.own_seconds, 2)
        times = (with_prefix(row.seconds, "s"), with_prefix(row.own_seconds, "s"))
        difference = f"{scientific(row.difference, 2)} of {row.of}"
        lines.append([row.work, row.program, *times, ratio, difference])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def main() -> None:
    """Run all peers and write the table."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--iso16281", type=Path, required=True)
    folder = asked.parse_args().iso16281
    warm()  # compiling is no part of the work
    rows = [*compare_iso_16281(folder), *compare_ross()]
    rows += compare_multibody()
    made = table(rows)
    print(made)
    DOCUMENT.write_text(put(DOCUMENT.read_text(encoding="utf-8"), MARK, made), encoding="utf-8")


if __name__ == "__main__":
    main()
