"""Lines of Python that make what a view shows: runnable as they stand, without the page.

Each begins with the scene, computes with `bearingcore` what the view draws, gathers it in `columns`
under the names of the view's CSV file, and draws it in short with Matplotlib.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from bearing_explorer.export.ball_mass_lines import mass_spectrum, mass_time, mechanism
from bearing_explorer.export.python_script import Script, quoted, short
from bearing_explorer.results.endurance import ASSUMED_VISCOSITY
from bearingcore import RACES, Scene
from bearingcore.dynamics.orbit import Orbit
from bearingcore.plan import CURVES
from bearingcore.scene.scene import WITH_MASS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bearing_explorer.results.results import Results


class Drawn(Protocol):
    """What is asked of a view: its name, and what a job has found where it has one."""

    @property
    def name(self) -> str:
        """The view's name."""


def lines_of(view: Drawn, results: Results) -> str:
    """The lines for a view as it stands."""
    script = Script(_scene_of(view, results))
    _MAKERS.get(view.name, _anything)(script, results, view)
    return script.text


def _scene_of(view: Drawn, results: Results) -> Scene:
    """The scene that is drawn: what a job has found may be of an earlier one."""
    found = getattr(view, "found", None)
    about = next((getattr(found, part) for part in ("map", "run") if hasattr(found, part)), found)
    scene = getattr(about, "scene", None)
    return scene if isinstance(scene, Scene) else results.scene


# What is computed


def _angles(script: Script, angles: NDArray[np.float64], results: Results, scene: str) -> str:
    """An expression for cage angles as they were drawn."""
    first, last, n = float(angles[0]), float(angles[-1]), angles.size
    script.numpy()
    if np.array_equal(angles, np.linspace(first, last, n)):
        ends = [short(first) if first else "0.0", short(last)]
        if last == results.scene.bearing.ball_spacing:
            ends[1] = "scene.bearing.ball_spacing"
        return f"np.linspace({ends[0]}, {ends[1]}, {n})"
    chosen = results.plan
    if chosen is not None and chosen.view in CURVES:
        script.part("plan", "plan")
        budget = short(chosen.error_budget)
        return f'plan({scene}, "{chosen.view}", {budget}).cage_angles'
    return f"np.array({quoted(repr(angles.tolist()))})"


def _beside(script: Script, results: Results) -> str:
    """The lines' name for what is drawn in grey; adds the pinned scene where there is one."""
    if results.pinned is None:
        return "scene.healthy()"
    script.add(f"pinned = {script.scene(results.pinned.scene)}  # what is drawn in grey")
    return "pinned"


def _both(
    script: Script, results: Results, function: str, ours: Any, others: Any, beside: str
) -> None:
    """Two answers of the core over their cage angles: `found` and `grey`."""
    script.core(function)
    angles = _angles(script, ours.cage_angles, results, "scene")
    other_angles = _angles(script, others.cage_angles, results, beside)
    script.add(
        f"found = {function}(scene, {angles})",
        f"grey = {function}({beside}, {other_angles})",
    )


def statics_of(results: Results) -> str:
    """The core's function that the statics on screen are from."""
    with_mass = results.scene.balls == WITH_MASS
    beside = results.pinned is not None and results.beside.balls == WITH_MASS
    return "static_state" if with_mass or beside else "equilibrium"


def _plot(script: Script, *lines: str) -> None:
    script.module("import matplotlib.pyplot as plt")
    script.add("", *lines, "plt.show()")


def _motion(script: Script, results: Results) -> None:
    """The simulated motion that is drawn, as `motion`."""
    motion, chosen = results.motion, results.plan
    rate = short(motion.sample_rate)
    duration = short(motion.time.size / motion.sample_rate)
    planned = chosen is not None and chosen.cage_angles is None
    if planned and chosen is not None and chosen.orbit is not None:
        script.core("orbit")
        script.part("dynamics.repeated", "repeated")
        script.add(
            f"found = orbit(scene, step_rate={short(_least_rate(chosen.orbit))})",
            f"motion = repeated(found, {duration}, {rate})  # the periodic orbit, again and again",
        )
    elif planned and chosen is not None and chosen.method == "adaptive steps":
        script.part("dynamics.adaptive", "simulate_adaptive")
        script.add(
            f"motion = simulate_adaptive(scene, {duration}, {rate}, "
            f"tolerance={short(chosen.tolerance)})"
        )
    else:
        script.core("simulate")
        moving = "scene"
        if motion.scene.balls != results.scene.balls:  # as the plan chose them
            moving = "moving"
            script.add(f'moving = scene.replace(balls="{motion.scene.balls}")')
        script.add(
            f"motion = simulate({moving}, {duration}, {rate}, step_rate={short(motion.step_rate)})"
        )


def _least_rate(found: Orbit) -> float:
    """A step rate [Hz] that gives an orbit its number of steps."""
    return (len(found.history) - 1.5) / found.period


# One maker a view


def _anything(script: Script, results: Results, view: Any) -> None:
    function = statics_of(results)
    script.core(function)
    angles = _angles(script, results.equilibrium.cage_angles, results, "scene")
    script.add(
        f"found = {function}(scene, {angles})  # see also the numbers of this view as CSV",
        "print(found.ball_load.max(), found.converged.all())",
    )


def _bearing(script: Script, results: Results, view: Any) -> None:
    script.numpy()
    script.core(statics_of(results))
    script.part("statics.passes", "drops_now")
    script.add(
        f"cage_angle = {short(results.cage_angle)}",
        f"now = {statics_of(results)}(scene, [cage_angle])",
        "angle = now.ball_angle[0]",
        "rows, balls = np.array([scene.bearing.row_of_ball(k) for k in range(angle.size)]).T",
        "columns = {",
        '    "row": 1 + rows,',
        '    "ball": 1 + balls,',
        '    "ball_angle_deg": np.degrees(angle),',
        '    "ball_load_n": now.ball_load[0],',
        '    "contact_angle_deg": np.degrees(now.contact_angle[0]),',
        *(
            f'    "drop_into_{race}_race_um": 1e6 * drops_now(scene, cage_angle, "{race}"),'
            for race in RACES
        ),
        "}",
    )
    _plot(
        script,
        'plt.subplot(projection="polar")',
        'plt.bar(angle, columns["ball_load_n"], width=0.5 * scene.bearing.ball_spacing)',
    )


def _life(script: Script, results: Results, view: Any) -> None:
    asked, found = results.asked, results.endurance
    if found.life is not None:
        script.core("life")
        rating = short(found.life.dynamic_load_rating)
        script.add(
            f'lasting = life(scene, {rating}, positions="all")  # C_r {found.rating_words}',
            "print(lasting.sentence)",
        )
    if found.pressures is not None:
        script.core("contact_pressures")
        script.add(
            "pressures = contact_pressures(scene)",
            "print(pressures.inner.greatest_pressure, pressures.outer.greatest_pressure)  # Pa",
        )
    if found.film is not None:
        script.core("film")
        script.add(
            "oil = film(",
            f"    scene, viscosity={short(asked.viscosity or ASSUMED_VISCOSITY)}, "
            f"roughness_inner={short(asked.race_roughness)},",
            f"    roughness_outer={short(asked.race_roughness)}, "
            f"roughness_ball={short(asked.ball_roughness)},",
            ")",
            "print(oil.sentence)",
        )


def _load_distribution(script: Script, results: Results, view: Any) -> None:
    beside = _beside(script, results)
    _both(
        script,
        results,
        statics_of(results),
        results.equilibrium,
        results.healthy_all_around,
        beside,
    )
    script.add(
        "columns = {}  # every position of every ball, row after row",
        f'for kind, answer in (("", found), ("{results.beside_name}_", grey)):',
        "    for row, own in enumerate(answer.scene.bearing.balls_of_rows):",
        '        name = kind + (f"row_{row + 1}_" if row else "")',
        "        angle = np.degrees(answer.ball_angle[:, own].ravel()) % 360.0",
        '        columns[f"{name}ball_angle_deg"] = angle',
        '        columns[f"{name}ball_load_n"] = answer.ball_load[:, own].ravel()',
    )
    _plot(
        script,
        f'for kind in ("{results.beside_name}_", ""):',
        '    angle, load = columns[f"{kind}ball_angle_deg"], columns[f"{kind}ball_load_n"]',
        '    plt.plot(angle, load, ".", label=kind or "shown")',
        'plt.xlabel("Angular position (°)")',
        'plt.ylabel("Ball load (N)")',
        "plt.legend()",
    )


def _depth_profile(script: Script, results: Results, view: Any) -> None:
    profile = results.profile
    script.numpy()
    script.part("statics.passes", "ball_drop")
    first, last = float(profile.angle[0]), float(profile.angle[-1])
    script.add(
        f"cage_angle = {short(results.cage_angle)}",
        f"angle = np.linspace({short(first)}, {short(last)}, 721)",
        "own = [",
        f'    defect for defect in scene.defects if defect.race == "{profile.race}"',
        f"    and defect.row in (None, {profile.row})",
        "]",
        "depths = [",
        "    defect.surface(",
        "        angle - defect.turn_ratio(scene.bearing) * cage_angle, scene.bearing",
        "    )",
        "    for defect in own",
        "]",
        "columns = {",
        '    "angle_deg": np.degrees(angle),',
        '    "race_depth_um": 1e6 * np.max([np.zeros(angle.size), *depths], axis=0),',
        '    "ball_center_drop_um": 1e6',
        f'    * ball_drop(scene, angle, cage_angle, "{profile.race}", {profile.row}),',
        "}",
    )
    _plot(
        script,
        'plt.plot(columns["angle_deg"], columns["race_depth_um"])',
        'plt.plot(columns["angle_deg"], columns["ball_center_drop_um"], "--")',
        "plt.gca().invert_yaxis()",
        'plt.xlabel("Angular position (°)")',
        'plt.ylabel("Depth (µm)")',
    )


def _stiffness(script: Script, results: Results, view: Any) -> None:
    beside = _beside(script, results)
    _both(
        script,
        results,
        statics_of(results),
        results.equilibrium,
        results.healthy_equilibrium,
        beside,
    )
    script.core("STIFFNESS_TERMS")
    script.add(
        "columns = {}",
        f'for kind, answer in (("defective", found), ("{results.beside_name}", grey)):',
        '    columns[f"{kind}_cage_angle_deg"] = np.degrees(answer.cage_angles)',
        "    for term in STIFFNESS_TERMS:",
        '        tilts = term.count("r")  # rows and columns of the matrix that are tilts',
        '        unit = ("n_per_m", "n_per_rad", "n_m_per_rad")[tilts]',
        '        columns[f"{kind}_{term}_{unit}"] = answer.term(term)',
        '    columns[f"{kind}_loaded_balls"] = answer.loaded_balls',
    )
    _plot(
        script,
        'figure, axes = plt.subplots(3, 5, sharex=True, layout="constrained")',
        "for term, axis in zip(STIFFNESS_TERMS, axes.flat, strict=True):",
        '    axis.plot(np.degrees(grey.cage_angles), grey.term(term), color="0.6")',
        "    axis.plot(np.degrees(found.cage_angles), found.term(term))",
        "    axis.set_title(term)",
    )


def _maps(script: Script, results: Results, view: Any) -> None:
    maps = results.maps
    script.numpy()
    script.core("stiffness_maps")
    scene = "scene"
    if results.focus:
        script.add(
            "defects = list(scene.defects)",
            f"defects.insert(0, defects.pop({results.focus}))  # the first is the one that grows",
        )
        scene = "scene.replace(defect=tuple(defects))"
    extents = f"np.linspace(0.0, {short(float(maps.extents[-1]))}, {maps.extents.size})"
    angles = _angles(script, maps.cage_angles, results, "scene")
    script.add(
        f"cage_angles = {angles}",
        f"maps = stiffness_maps({scene}, {extents}, cage_angles)",
        'extents, angles = np.meshgrid(maps.extents, maps.cage_angles, indexing="ij")',
        "columns = {",
        '    "extent_deg": np.degrees(extents),',
        '    "cage_angle_deg": np.degrees(angles),',
        '    "loaded_balls": maps.loaded_balls,',
        '    "greatest_ball_load_n": maps.greatest_load,',
        '    "k_xx_n_per_m": maps.term("k_xx"),',
        '    "k_yy_n_per_m": maps.term("k_yy"),',
        "}  # and so on for all of bearingcore.STIFFNESS_TERMS",
    )
    _plot(
        script,
        "plt.pcolormesh(",
        '    columns["cage_angle_deg"], columns["extent_deg"], 1e-6 * columns["k_yy_n_per_m"]',
        ")",
        'plt.xlabel("Cage angle (°)")',
        'plt.ylabel("Extent (°)")',
        'plt.colorbar(label="k_yy (MN/m)")',
    )


def _modes(script: Script, results: Results, view: Any) -> None:
    beside = _beside(script, results)
    _both(script, results, "modes", results.modes, results.healthy_modes, beside)
    script.core("frequency_bands")
    name = results.beside_name
    script.add(
        f'columns = (found.table() | grey.table().prefixed("{name}")).in_units().named()',
        "print(frequency_bands(scene))  # least and greatest of each mode [Hz]",
    )
    _plot(
        script,
        'plt.plot(np.degrees(grey.cage_angles), grey.frequency, color="0.6")',
        "plt.plot(np.degrees(found.cage_angles), found.frequency)",
        'plt.xlabel("Cage angle (°)")',
        'plt.ylabel("Natural frequency (Hz)")',
    )


def _vibration_time(script: Script, results: Results, view: Any) -> None:
    shown = results.excerpt
    _motion(script, results)
    motion = results.motion
    first = int(np.searchsorted(motion.time, shown.motion_time + shown.time[0] - 1e-9))
    last = first + shown.time.size
    script.add(
        f"first, last = {first}, {last}  # samples: the ball passes that are drawn",
        f"balls = {shown.balls.tolist()}  # counted from 0",
        f'columns = {{"time_s": motion.time[first:last] - {short(shown.motion_time)}}}',
        "for i, dof in enumerate(motion.dofs):",
        '    unit = "rad_per_s2" if dof.startswith("r") else "m_per_s2"',
        '    columns[f"acceleration_{dof}_{unit}"] = motion.outer_acceleration[first:last, i]',
        "loads = motion.ball_loads(first, last)",
        "for ball in balls:",
        '    columns[f"ball_{ball + 1}_load_n"] = loads[:, ball]',
    )
    _plot(
        script,
        'for name in ("acceleration_x_m_per_s2", "acceleration_y_m_per_s2"):',
        '    plt.plot(columns["time_s"], columns[name], label=name)',
        'plt.xlabel("Time (s)")',
        'plt.ylabel("Acceleration of the housing (m/s²)")',
        "plt.legend()",
    )


def _late(script: Script, results: Results) -> None:
    """Lines for the spectra of the settled motion."""
    first = math.ceil(results.settled_since * results.motion.sample_rate - 1e-6)
    script.core("spectrum")
    script.add(
        "frequency, density = spectrum(",
        f"    motion.outer_acceleration[{first}:], motion.sample_rate",
        ")  # when its start is forgotten",
    )


def _densities(name: str, dofs: str, values: str) -> list[str]:
    """Lines that put the spectra of all directions into `columns`; `values` has the index i."""
    return [
        f"for i, dof in enumerate({dofs}):",
        '    unit = "rad2_per_s4_per_hz" if dof.startswith("r") else "m2_per_s4_per_hz"',
        f'    columns[f"{name}_{{dof}}_{{unit}}"] = {values}',
    ]


def _vibration_spectrum(script: Script, results: Results, view: Any) -> None:
    beside = _beside(script, results)
    _motion(script, results)
    _late(script, results)
    other = results.healthy_motion
    half = math.ceil(results.healthy_settled_since * other.sample_rate - 1e-6)
    name = results.beside_name
    script.core("simulate")
    script.add(
        f"grey = simulate(\n    {beside},\n    {short(other.time.size / other.sample_rate)},"
        f"\n    {short(other.sample_rate)},\n    step_rate={short(other.step_rate)},\n)",
        "grey_frequency, grey_density = spectrum(",
        f"    grey.outer_acceleration[{half}:], grey.sample_rate",
        ")",
        f'columns = {{"frequency_hz": frequency, "{name}_frequency_hz": grey_frequency}}',
        *_densities("density", "motion.dofs", "density[:, i]"),
        *_densities(f"{name}_density", "grey.dofs", "grey_density[:, i]"),
    )
    _plot(
        script,
        'plt.semilogy(grey_frequency, grey_density, color="0.6")',
        "plt.semilogy(frequency, density)",
        'plt.xlabel("Frequency (Hz)")',
        'plt.ylabel("Power spectral density ((m/s²)²/Hz)")',
    )


def _orbit(script: Script, results: Results, view: Any) -> None:
    script.numpy()
    script.core("orbit")
    settings = results.settings
    script.add(
        "found = orbit(scene)",
        "print(found.status)",
        "columns = found.table().named()",
    )
    if results.orbit is not None and results.orbit.multipliers.size:
        script.add(
            "time = np.linspace(0.0, found.period, 1001)",
            "path = found.inner_displacement(time)",
            "frequency, density = found.spectrum(",
            f"    {short(settings.sample_rate)}, duration={short(0.5 * settings.duration)}",
            ")",
            'columns["frequency_hz"] = frequency',
            "for i, dof in enumerate(found.dofs):",
            '    if dof in ("x", "y"):',
            '        columns[f"orbit_density_{dof}_m2_per_s4_per_hz"] = density[:, i]',
        )
        _plot(
            script,
            "plt.plot(1e6 * path[:, 0], 1e6 * path[:, -1 if path.shape[1] < 2 else 1])",
            'plt.xlabel("Displacement of the inner ring along x (µm)")',
            'plt.ylabel("along y (µm)")',
        )


def _stability_map(script: Script, results: Results, view: Any) -> None:
    found = view.found
    if found is None:
        _nothing_yet(script)
        return
    script.numpy()
    script.part("dynamics.stability_map", "stability_map")
    script.add(
        "found = stability_map(",
        "    scene,",
        *(
            f'    ("{name}", np.linspace({short(values[0])}, {short(values[-1])}, {values.size})),'
            for name, values in (found.x.in_si, found.y.in_si)
        ),
        ")",
        'y, x = np.meshgrid(found.y, found.x, indexing="ij")',
        'columns = found.table().only("largest_multiplier", "outcome", "through").named()',
    )
    _plot(script, "plt.pcolormesh(x, y, np.minimum(found.multiplier, 1.5))", "plt.colorbar()")


def _explore(script: Script, results: Results, view: Any) -> None:
    found = view.found
    if found is None:
        _nothing_yet(script)
        return
    script.numpy()
    x, y = (
        (name, f"np.linspace({short(values[0])}, {short(values[-1])}, {values.size})")
        for name, values in (found.x.in_si, found.y.in_si)
    )
    output = found.question.output
    if output.in_sweep:
        script.part("sweep", "sweep")
        mode = f'.sel(mode="{output.mode}")' if output.mode else ""
        settings = []
        if output.band is not None:
            script.part("sweep.outputs", "Settings")
            low, high = (short(edge) for edge in output.band)
            settings = [f"    settings=Settings(band_low={low}, band_high={high}),"]
        script.add(
            "swept = sweep(",
            "    scene,",
            f'    over={{"{y[0]}": {y[1]}, "{x[0]}": {x[1]}}},',
            f'    outputs=["{output.in_sweep}"],',
            *settings,
            ")",
            f'values = swept["{output.in_sweep}"]{mode}.values',
        )
    else:
        script.part("diagnosis.sizing_error", "extent_error")
        script.add(
            f"x, y = {x[1]}, {y[1]}",
            "values = np.full((y.size, x.size), np.nan)",
            "for j, i in np.ndindex(values.shape):",
            f'    at = scene.replace(**{{"{x[0]}": x[i], "{y[0]}": y[j]}})',
            "    try:",
            "        values[j, i] = np.degrees(extent_error(at).error)",
            "    except ValueError as why:",
            "        print(why)",
        )
    script.add(f'columns = {{"{output.column}": values}}')
    _plot(script, f"plt.pcolormesh({x[1]}, {y[1]}, values)", "plt.colorbar()")


def _speed_run(script: Script, results: Results, view: Any) -> None:
    found = view.found
    if found is None:
        _nothing_yet(script)
        return
    script.numpy()
    script.part("dynamics.speed_run", "speed_run")
    speeds = found.run.shaft_speed
    step = found.run.frequency[1] - found.run.frequency[0]
    script.add(
        f"speeds = np.linspace({short(speeds[0])}, {short(speeds[-1])}, {speeds.size})",
        f"run = speed_run(scene, speeds, resolution={short(float(step))})",
        'columns = run.table().in_units({"rad/s": "Hz"}).named()',
    )
    _plot(
        script,
        'speed, frequency = np.meshgrid(run.shaft_speed, run.frequency, indexing="ij")',
        "plt.pcolormesh(frequency, speed, 10.0 * np.log10(run.density[:, :, -1] + 1e-12))",
        'plt.xlabel("Frequency (Hz)")',
        'plt.ylabel("Shaft speed (rad/s)")',
    )


def _accuracy(script: Script, results: Results, view: Any) -> None:
    found = view.found
    if found is None:
        _nothing_yet(script)
        return
    chart = "stability_chart(scene, duration=0.1)"
    call = _EXPERIMENTS.get(getattr(found.result, "name", ""), chart)
    script.part("experiments", call.partition("(")[0])
    which = "trials" if call is chart else "points"
    script.add(f"result = {call}", f"for point in result.{which}:", "    print(point)")


_EXPERIMENTS = {
    "motion": "motion_experiment(scene, duration=0.1)",
    "models": "models_experiment(scene, duration=0.2)",
    "statics": "statics_experiment(scene, n_angles=31)",
    "angles": "angles_experiment(scene)",
}


def _dofs(script: Script, results: Results, view: Any) -> None:
    found = results.dof_comparison
    script.core(statics_of(results))
    script.numpy()
    angles = _angles(script, results.equilibrium.cage_angles, results, "scene")
    script.add(
        f"angles = {angles}",
        f"chosen = {statics_of(results)}(scene, angles)",
        f"other = {statics_of(results)}(scene.replace(dofs={quoted(repr(found.other))}), angles)",
        'for term in ("k_xx", "k_yy"):',
        "    difference = np.abs(chosen.term(term) - other.term(term)).max()",
        "    print(term, difference / np.abs(other.term(term)).max())",
    )


def _bearing_editor(script: Script, results: Results, view: Any) -> None:
    script.add(
        "bearing, speed = scene.bearing, scene.shaft_speed",
        "for row, (own, _) in enumerate(bearing.unlike_rows):",
        "    frequencies = {",
        '        "BPFO": own.bpfo(speed),',
        '        "BPFI": own.bpfi(speed),',
        '        "FTF": own.ftf(speed),',
        '        "BSF": own.bsf(speed),',
        "    }  # [Hz]",
        "    print(row + 1, own, frequencies)",
    )


def _model_editor(script: Script, results: Results, view: Any) -> None:
    script.core("contact_damping")
    script.add(
        "damping = contact_damping(scene)  # [N·s/m] of a loaded contact",
        "print(scene.support, damping)",
    )


def _plan(script: Script, results: Results, view: Any) -> None:
    script.part("plan", "plan")
    views = ", ".join(f'"{name}"' for name in type(view).plans)
    script.add(f"for view in ({views}):", "    print(view, plan(scene, view).sentence())")


def _nothing_yet(script: Script) -> None:
    script.add("# nothing has been computed in this view yet")


_MAKERS: dict[str, Callable[[Script, Results, Any], None]] = {
    "bearing": _bearing,
    "life": _life,
    "load-distribution": _load_distribution,
    "depth-profile": _depth_profile,
    "stiffness": _stiffness,
    "maps": _maps,
    "modes": _modes,
    "vibration-time": _vibration_time,
    "vibration-spectrum": _vibration_spectrum,
    "mass-time": mass_time,
    "mass-spectrum": mass_spectrum,
    "mechanism": mechanism,
    "orbit": _orbit,
    "stability-map": _stability_map,
    "explore": _explore,
    "speed-run": _speed_run,
    "accuracy": _accuracy,
    "plan": _plan,
    "dofs": _dofs,
    "bearing-editor": _bearing_editor,
    "model-editor": _model_editor,
}
