"""Lines of Python beside a measurement: the file is read, compared and sized without the page."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from bearing_explorer.export.python_script import Script, quoted, short
from bearing_explorer.measurement.diagnoses import ROUGH, SLIP
from bearing_explorer.measurement.signal import Measured

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results


def measured_lines(view: Any, results: Results, measured: Measured) -> str:
    """The lines for a view of a measurement as it stands."""
    script = Script(measured.scene(results.scene))
    _recording(script, measured)
    _MAKERS[view.name](script, results, measured, view)
    return script.text


_AS_IN_FILE = "# the unit of the file is not known: the numbers are taken as they stand"


def column_name(direction: str, in_si: bool) -> str:
    """Of the signal along a direction; without a unit where nobody knows it."""
    return f"acceleration_{direction}_m_per_s2" if in_si else f"signal_{direction}"


def _recording(script: Script, measured: Measured) -> None:
    recording, origin = measured.recording, measured.origin
    along = quoted(repr(list(recording.directions)))
    rate = short(recording.sample_rate)
    if origin is not None:
        script.core("read_table")
        script.module("from pathlib import Path")
        name = quoted(repr(origin.file))
        columns = list(origin.columns)
        unit = quoted(repr(origin.unit if measured.in_si else "m/s²"))
        script.add(
            f"table = read_table({name}, Path({name}).read_bytes())",
            *([] if measured.in_si else [_AS_IN_FILE]),
            f"recording = table.recording({columns}, {along}, {unit}, {rate}, "
            f"{short(origin.full_scale)}{_beside(measured)})",
        )
        return
    script.core("Recording", "simulate")
    duration = math.ceil(10.0 * recording.duration) / 10.0
    script.add(
        "# simulated anew: without noise, and just as the scene says",
        f"motion = simulate(scene, {short(duration + 0.3)}, {rate})",
        f"own = [motion.dofs.index(dof) for dof in {along}]",
        "settled = motion.outer_acceleration[motion.time >= 0.3]",
        f"recording = Recording(settled[:, own], {rate}, {along})",
    )


def _beside(measured: Measured) -> str:
    """What is known of sensor and shaft, as further arguments."""
    known = {
        "sensitivity": measured.origin.sensitivity if measured.origin is not None else None,
        "shaft_speed": measured.recording.shaft_speed,
    }
    return "".join(f", {name}={short(v)}" for name, v in known.items() if v is not None)


def _signal(script: Script, direction: str) -> None:
    script.add(
        f'signal = recording.acceleration[:, recording.directions.index("{direction}")]',
        "signal = signal - signal.mean()",
    )


def _plot(script: Script, *lines: str) -> None:
    script.module("import matplotlib.pyplot as plt")
    script.add("", *lines, "plt.show()")


def _in_time(script: Script, results: Results, measured: Measured, view: Any) -> None:
    script.numpy()
    script.add(
        "time = np.arange(len(recording.acceleration)) / recording.sample_rate",
        "columns = {",
        '    "time_s": time,',
        *(
            f'    "{column_name(dof, measured.in_si)}": recording.acceleration[:, {index}],'
            for index, dof in enumerate(measured.directions)
        ),
        "}",
    )
    _plot(
        script,
        "plt.plot(time, recording.acceleration, label=recording.directions)",
        'plt.xlabel("Time (s)")',
        'plt.ylabel("Acceleration (m/s²)")'
        if measured.in_si
        else 'plt.ylabel("Numbers of the file, unit not known")',
        "plt.legend()",
    )


def _spectrum(script: Script, results: Results, measured: Measured, view: Any) -> None:
    shown = view.shown(results, measured)
    script.numpy()
    script.core("spectrum")
    _signal(script, shown.direction)
    script.add(
        f"found = spectrum(signal, recording.sample_rate, {short(shown.resolution)})",
    )
    _columns(script, shown.direction, shown.top)


def _envelope(script: Script, results: Results, measured: Measured, view: Any) -> None:
    shown = view.shown(results, measured)
    low, high = shown.band
    script.numpy()
    script.core("envelope_spectrum")
    _signal(script, shown.direction)
    resolution = measured.envelope_resolution(shown.top)
    script.add(
        f"band = ({short(low)}, {short(high)})  # Hz",
        "found = envelope_spectrum(",
        f"    signal, recording.sample_rate, band, {short(resolution)}",
        ")",
    )
    _columns(script, shown.direction, shown.top)


def _columns(script: Script, direction: str, top: float) -> None:
    script.add(
        f"shown = found.frequency <= {short(top)}",
        "columns = {",
        '    "measured_frequency_hz": found.frequency[shown],',
        f'    "measured_density_{direction}_m2_per_s4_per_hz": found.density[shown],',
        "}",
        'print("BPFO", scene.bearing.bpfo(scene.shaft_speed), "Hz")',
    )
    _plot(
        script,
        "plt.semilogy(*columns.values())",
        'plt.xlabel("Frequency (Hz)")',
        'plt.ylabel("Density ((m/s²)²/Hz)")',
    )


def _diagnosis(script: Script, results: Results, measured: Measured, view: Any) -> None:
    script.core("diagnose")
    speed = {
        "given": "scene.shaft_speed",
        "rough": f"({1.0 - ROUGH:g} * scene.shaft_speed, {1.0 + ROUGH:g} * scene.shaft_speed)",
        "unknown": "None",
    }[view.speed]
    script.add(
        f"found = diagnose(recording, scene.bearing, {speed}, slip={SLIP:g})",
        "print(found.status)",
        "columns = found.table().in_units().named()",
    )
    _plot(
        script,
        'plt.plot(columns["envelope_frequency_hz"], columns["envelope_level_db"])',
        "for part in found.evidence:",
        '    plt.axvline(part.frequency, linestyle="--", label=part.part)',
        'plt.xlabel("Frequency (Hz)")',
        'plt.ylabel("Over the surroundings (dB)")',
        "plt.legend()",
    )


def _size(script: Script, results: Results, measured: Measured, view: Any) -> None:
    script.numpy()
    script.core("size_defect")
    script.add(
        "sized = size_defect(recording, scene)  # the extent of the scene is not looked at",
        "print(sized.status)",
        "columns = {",
        '    "extent_deg": np.degrees([c.extent for c in sized.candidates]),',
        '    "probability": np.array([c.probability for c in sized.candidates]),',
        "}",
    )
    _plot(
        script,
        'plt.bar(columns["extent_deg"], columns["probability"])',
        'plt.xlabel("Extent (°)")',
        'plt.ylabel("Probability")',
    )


_MAKERS = {
    "measurement": _in_time,
    "measured-spectrum": _spectrum,
    "measured-envelope": _envelope,
    "diagnosis": _diagnosis,
    "sizing": _size,
}
