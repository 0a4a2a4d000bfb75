"""Lines of Python that make what the views of the balls' mass show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bearing_explorer.export.python_script import Script, short
from bearingcore.scene.scene import BALLS

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results


def _motions(script: Script, results: Results) -> None:
    """Both motions, as `massless` and `heavy`."""
    found = results.ball_mass
    duration, rate = short(found.samples / found.sample_rate), short(found.sample_rate)
    script.core("simulate")
    for name, balls in zip(("massless", "heavy"), BALLS, strict=True):
        script.add(
            f'{name} = simulate(\n    scene.replace(balls="{balls}"), {duration}, {rate},'
            f"\n    step_rate={short(found.step_rates[balls])},\n)"
        )


def _plot(script: Script, *lines: str) -> None:
    script.module("import matplotlib.pyplot as plt")
    script.add("", *lines, "plt.show()")


def mass_time(script: Script, results: Results, view: Any) -> None:
    """Acceleration and loads while a ball passes the defect."""
    found = results.ball_mass
    _motions(script, results)
    zero = found.first / found.sample_rate - float(found.time[0])
    script.add(
        f"first, last = {found.first}, {found.first + found.time.size}  # samples that are drawn",
        f"balls = {found.balls.tolist()}  # counted from 0",
        f'columns = {{"time_s": heavy.time[first:last] - {short(zero)}}}',
        'for name, motion in (("massless", massless), ("with_mass", heavy)):',
        "    for i, dof in enumerate(motion.dofs):",
        '        if dof in ("x", "y"):',
        "            signal = motion.outer_acceleration[first:last, i]",
        '            columns[f"{name}_acceleration_{dof}_m_per_s2"] = signal',
        "loads = heavy.race_loads(first, last)",
        "for ball in balls:",
        '    for race, load in zip(("inner", "outer"), loads):',
        '        columns[f"ball_{ball + 1}_{race}_race_load_n"] = load[:, ball]',
    )
    _plot(
        script,
        'for name in ("with_mass", "massless"):',
        '    plt.plot(columns["time_s"], columns[f"{name}_acceleration_y_m_per_s2"], label=name)',
        'plt.xlabel("Time (s)")',
        'plt.ylabel("Acceleration of the housing (m/s²)")',
        "plt.legend()",
    )


def _densities(script: Script, results: Results) -> None:
    """Spectra of both settled motions along x and y."""
    _motions(script, results)
    script.core("spectrum")
    script.add(
        "frequency, densities = None, {}",
        'for name, motion in (("massless", massless), ("with_mass", heavy)):',
        '    shown = [i for i, dof in enumerate(motion.dofs) if dof in ("x", "y")]',
        f"    settled = motion.outer_acceleration[{results.ball_mass.settled}:, shown]",
        "    frequency, densities[name] = spectrum(settled, motion.sample_rate)",
    )


def mass_spectrum(script: Script, results: Results, view: Any) -> None:
    """Both spectra."""
    _densities(script, results)
    script.add(
        'columns = {"frequency_hz": frequency}',
        "for name, density in densities.items():",
        '    for dof, values in zip([d for d in heavy.dofs if d in ("x", "y")], density.T):',
        '        columns[f"{name}_density_{dof}_m2_per_s4_per_hz"] = values',
    )
    _plot(
        script,
        "for name, density in densities.items():",
        "    plt.loglog(frequency, density.sum(axis=1), label=name)",
        'plt.xlabel("Frequency (Hz)")',
        'plt.ylabel("Power spectral density ((m/s²)²/Hz)")',
        "plt.legend()",
    )


def mechanism(script: Script, results: Results, view: Any) -> None:
    """Share of the power that mass adds, by octave."""
    octaves = results.ball_mass.octaves
    _densities(script, results)
    script.numpy()
    script.add(
        f"octaves = {short(float(octaves[0]))} * 2.0 ** np.arange({octaves.size})",
        "inside = [",
        "    (frequency >= low) & (frequency < high)",
        "    for low, high in zip(octaves[:-1], octaves[1:])",
        "]",
        "power = {",
        "    name: np.array([density[octave].sum() for octave in inside])",
        "    for name, density in densities.items()",
        "}",
        'ratio = power["with_mass"] / power["massless"]',
        "columns = {",
        '    "lowest_frequency_hz": octaves[:-1],',
        '    "highest_frequency_hz": octaves[1:],',
        '    "mass_share": 1.0 - 1.0 / ratio,',
        '    "added_db": 10.0 * np.log10(ratio),',
        "}",
    )
    _plot(
        script,
        'plt.bar(np.log2(octaves[:-1]) + 0.5, 100.0 * columns["mass_share"])',
        'plt.xlabel("Octave: binary logarithm of the frequency in Hz")',
        'plt.ylabel("Share of the power that mass adds (%)")',
    )
