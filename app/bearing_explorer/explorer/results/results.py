"""Results of one scene, computed when they are first needed.

Everything that is drawn passes through here. Costly results come from the functions of `statics`,
`motions` and `endurance`, and all sessions share them.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence, Set
from dataclasses import KW_ONLY, dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bearingcore as core
from bearing_explorer.explorer.results import endurance, motions, statics, verdict
from bearing_explorer.explorer.results.ball_mass import BallMass
from bearing_explorer.explorer.results.chain import Chain, Peak, chain_of, loudest
from bearing_explorer.explorer.results.defect_shape import Profile, profile
from bearing_explorer.explorer.results.endurance import Endurance, LifeInputs
from bearing_explorer.explorer.results.excerpt import Excerpt, why_ended
from bearing_explorer.explorer.results.load_curve import Curve, load_curve
from bearing_explorer.explorer.results.verdict import Verdict
from bearing_explorer.explorer.state.field_values import defects_of
from bearing_explorer.explorer.state.references import (
    HEALTHY,
    OTHER_BALLS,
    Reference,
    grey_reference,
)
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.settings import Marching, Settings
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearing_explorer.kit.compute.compiling import StillCompiling
from bearing_explorer.kit.compute.executors import PICTURES
from bearing_explorer.kit.sentences import words_of
from bearing_explorer.kit.views.content import SceneContent, Warnings
from bearing_explorer.kit.views.python_lines import changed_fields, code_of, scene_code, short
from bearingcore import Equilibrium, Limit, Maps, Modes, Motion, Scene, Spectrum
from bearingcore.common import cached_property
from bearingcore.model.scene import MASSLESS, WITH_MASS
from bearingcore.model.statics import (
    EquilibriumWithMass,
    StaticRanges,
    default_cage_angles,
    has_long_period,
    ranges_of,
    summary,
)

MAP_REACHES = tuple(math.radians(reach) for reach in (90.0, 120.0, 180.0, 360.0))
"""Greatest extents of maps [rad]; the first that holds the shown extent is used. Paper: 90°."""

OF_MOTION = frozenset({"motion", "excerpt", "late_spectra", "ball_mass", "chain"})
"""Attributes of `Results` that need a simulated motion; they are drawn after the others."""
OVER_STRETCH = frozenset({"equilibrium", "ranges", "modes", "bands", "chain"})
"""Attributes over the cage angles of the curves, which are fewer while a slider moves."""


@cached
def _chain_of(scene: Scene, cage_angle: float, settings: Settings, moving: bool) -> Chain:
    """Chain of another scene; a whole drag is compared with the chain where it began."""
    return Results(scene, cage_angle, settings, moving=moving).chain


@dataclass(frozen=True, eq=False)
class Results(SceneContent):
    """All results that views read. Attributes are computed when first needed, in any thread.

    Parameters
    ----------
    scene, cage_angle [rad]
        scene and cage angle on screen.
    settings
        fineness of the computation.
    focus
        index of the selected defect.
    moving
        True while a slider moves and a quick answer is wanted.
    held
        True while a hand holds a slider or handle; the scales that it uses must stay.
    compared
        scenes that are drawn for comparison, each with a name.
    before
        scene before the last change; None before the first.
    grey_kind
        kind of the reference that is drawn in grey.
    life_inputs
        steel, oil and surfaces as entered under Life.
    lesson_term
        term of the stiffness that the open lesson compares between scenes; empty without one.
    mark
        number of the newest change of the browser that is in these results.
    like
        other results whose stretch and steps these share.
    """

    slow: ClassVar[Set[str]] = OF_MOTION

    scene: Scene
    cage_angle: float = 0.0
    settings: Settings = field(default_factory=Settings)
    focus: int = 0
    _: KW_ONLY
    moving: bool = False
    held: bool = False
    compared: Sequence[Reference] = ()
    before: Reference | None = None
    grey_kind: str = HEALTHY
    life_inputs: LifeInputs = field(default_factory=LifeInputs)
    lesson_term: str = ""
    mark: int = 0
    like: Results | None = None
    _against: dict[tuple[Scene, bool], Results] = field(default_factory=dict, init=False)

    @property
    def fine_key(self) -> tuple[object, ...]:
        """Key of a fine picture. It has no cage angle: a turned bearing keeps its fine picture."""
        return self.scene, self.settings, self.compared, self.grey_kind

    def against(self, reference: Reference, *, own_period: bool = False) -> Results:
        """Results of another scene, to be compared with these.

        They have the same cage angles and steps, or with `own_period` those of that scene.
        """
        key = reference.scene, own_period
        if key not in self._against:
            self._against[key] = Results(
                reference.scene,
                self.cage_angle,
                self.settings,
                moving=self.moving,
                like=None if own_period else self,
            )
        return self._against[key]

    @cached_property
    def editor(self) -> SceneEditor:
        """An editor with this scene, for forms outside of the page."""
        editor = SceneEditor("fan-rig")
        editor.take_scene(self.scene, selected=self.focus)
        return editor

    @cached_property
    def compared_results(self) -> list[Results]:
        """Results of the compared scenes in their order, each over its own period."""
        return [self.against(reference, own_period=True) for reference in self.compared]

    @cached_property
    def grey(self) -> Reference:
        """The reference that is drawn in grey."""
        return grey_reference(self.scene, self.grey_kind)

    @property
    def reference(self) -> Results:
        """Results of the reference that is drawn in grey."""
        return self.against(self.grey)

    @property
    def over_shaft(self) -> bool:
        """True if curves are drawn over a turn of the shaft, because a defect turns with it."""
        return self.scene.defect_turns

    @cached_property
    def stretch(self) -> tuple[float, float, int]:
        """First and last cage angle [rad] of the curves, and the number of cage angles.

        The stretch is a ball spacing, after which everything repeats; for rows of unlike balls a
        common multiple of their spacings, or a turn of the cage. With a defect of the inner race
        nothing repeats so soon: the stretch is the turn of the shaft at the shown cage angle.
        """
        if self.like is not None:
            return self.like.stretch
        settings = self.settings
        n = settings.n_cage_angles
        if self.moving:
            n = min(n, settings.n_while_moving)
        if has_long_period(self.scene):
            n = min(n, settings.n_long_period)
        angles = default_cage_angles(self.scene, n)
        length = float(angles[-1])
        turn = math.floor(self.cage_angle / length + 1e-9) if self.over_shaft else 0
        return turn * length, (turn + 1) * length, angles.size

    def along(self, cage_angle: ArrayLike) -> NDArray[np.float64]:
        """Convert cage angles [rad] to places on the curves [deg], within the stretch.

        These are angles of the cage, or of the shaft if curves are over a turn of the shaft.
        """
        first, last, _ = self.stretch
        angle = np.asarray(cage_angle, dtype=float)
        inside = first + np.where(angle == last, last - first, (angle - first) % (last - first))
        if self.over_shaft:
            return 360.0 * (inside - first) / (last - first)
        return np.degrees(inside)

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """Static equilibrium over the stretch."""
        return statics.curves(self.scene, *self.stretch)

    @cached_property
    def ranges(self) -> StaticRanges:
        """Least, greatest and mean of static results, over all positions of the bearing.

        If a defect turns with the shaft, these are more positions than one turn of the curves.
        """
        if self.over_shaft or (self.like is not None and self.like.over_shaft):
            return statics.ranges(self.scene, self.moving)
        return ranges_of(self.equilibrium)

    @cached_property
    def load_curves(self) -> list[Curve]:
        """Load [N] of a ball over its angle [rad], one curve for each row; see `load_curve`."""
        rows = range(len(self.scene.bearing.all_rows))
        return [load_curve(self.ranges.state, row) for row in rows]

    @cached_property
    def inner_load_curves(self) -> list[Curve]:
        """Load curves at the inner race, where balls with mass carry less; empty if massless."""
        state = self.ranges.state
        if not isinstance(state, EquilibriumWithMass) or state.positions.centrifugal_load == 0.0:
            return []
        rows = range(len(state.scene.bearing.all_rows))
        return [load_curve(state, row, state.inner_load) for row in rows]

    @cached_property
    def now(self) -> Equilibrium:
        """Static equilibrium at the shown cage angle; arrays of length 1."""
        return statics.curves(self.scene, self.cage_angle, self.cage_angle, 1)

    @cached_property
    def modes(self) -> Modes:
        """Natural frequencies over the stretch."""
        return statics.modes(self.scene, *self.stretch)

    @cached_property
    def bands(self) -> dict[str, tuple[float, float]]:
        """Least and greatest frequency [Hz] of each mode over all positions of the bearing.

        The search covers all turns of the shaft and places between the cage angles of curves, so
        the result does not depend on their number. It is coarser while a slider moves.
        """
        return statics.bands(self.scene, self.moving)

    @property
    def extent(self) -> float:
        """Extent [rad] of the selected defect."""
        return defects_of(self.scene)[self.focus].extent

    @cached_property
    def maps(self) -> Maps:
        """Stiffness and loaded balls over extents of the selected defect and cage angles.

        All extents that a map holds share it: a change of the extent computes nothing.
        """
        first, last, _ = self.stretch
        others = list(defects_of(self.scene))
        selected = dataclasses.replace(others.pop(self.focus), extent=0.0)
        scene = self.scene.replace(defect=(selected, *others) if others else selected)
        reach = next(reach for reach in MAP_REACHES if self.extent <= reach * 1.000001)
        # a turn of the shaft holds about five ball spacings, but five times the angles would be
        # too much to send: twice as many are taken
        n = self.settings.n_map_angles
        columns = 2 * n - 1 if has_long_period(self.scene) else n
        return statics.maps(scene, reach, self.settings.n_extents, first, last, columns)

    @cached_property
    def drop(self) -> dict[str, np.ndarray]:
        """Drop [m] of each ball's centre into the outer and the inner race, by race."""
        return statics.drops(self.scene, self.cage_angle)

    @cached_property
    def profile(self) -> Profile:
        """The race around the defect and the path of a ball's centre over it."""
        return profile(self.scene, self.cage_angle, self.focus)

    def prefetch(self, needed: frozenset[str]) -> None:
        """Begin in another thread the part of these attributes that can be computed in parallel."""
        if {"late_spectra", "reference"} <= needed:
            key = self.grey.scene, self.reference.marching
            if not motions.late_spectra.knows(*key):  # the picture waits for this one
                PICTURES.submit(motions.late_spectra, *key)

    def status(self, seconds: float, needed: frozenset[str] = frozenset()) -> dict[str, Any]:
        """Status line of results that took `seconds` [s], for views that need these attributes."""
        mood, words = self.verdict(needed)
        details = verdict.details_of(self.equilibrium)
        if self.is_coarse(needed):
            details.append("coarse while it moves: a shorter motion, in fewer steps")
        details.append(f"{1e3 * seconds:.1f} ms of computing")
        return {"mood": mood, "words": words, "details": details, "resting": not self.moving}

    def verdict(self, shown: frozenset[str]) -> Verdict:
        """Verdict on the results on screen; `shown` are the attributes that its views read.

        The first failure counts, because without a static state there is no motion.
        """
        bad = verdict.statics_words(self.equilibrium)
        if not bad and "now" in shown and not self.now.converged[0]:
            bad = f"No answer at this cage angle: {self.now.reason(0)}"
        if not bad and "chain" in shown:
            bad = verdict.chain_words(self.chain)
        if bad:
            return Verdict("bad", bad)
        try:
            if "ball_mass" in shown and self.ball_mass.broke_off:
                return Verdict("bad", f"No motion: {self.ball_mass.broke_off}")
            if shown & verdict.MOTIONS and self.fault:
                return Verdict("bad", f"The motion {self.fault}")
        except StillCompiling as wait:
            return Verdict("busy", f"Not ready: {wait}")
        except ValueError as error:  # the view gives the whole sentence
            return Verdict("bad", f"No motion: {words_of(error)}")
        return Verdict("good", "Computed without problems")

    def arguments(self, needed: frozenset[str]) -> dict[str, str]:
        """Arguments, other than the usual ones, of a figure that needs these attributes."""
        arguments: dict[str, str] = {}
        if self.cage_angle:
            arguments["cage_angle"] = short(self.cage_angle)
        if self.focus:
            arguments["focus"] = str(self.focus)
        if self.before is not None and "before" in needed:
            arguments["before"] = scene_code(self.before.scene)
        if self.grey_kind != HEALTHY and "reference" in needed:
            arguments["grey"] = code_of(self.grey_kind)
        for name, value, usual in (
            ("settings", self.settings, Settings()),
            ("endurance", self.life_inputs, LifeInputs()),
        ):
            if changed := changed_fields(value, usual):
                arguments[name] = code_of(changed)
        return arguments

    @property
    def compared_argument(self) -> dict[str, str]:
        """Argument of a figure that draws compared scenes; empty without them."""
        named = (f"{code_of(other.name)}: {scene_code(other.scene)}" for other in self.compared)
        return {"compared": "{" + ", ".join(named) + "}"} if self.compared else {}

    def is_coarse(self, shown: frozenset[str]) -> bool:
        """True if any of the shown attributes comes from a motion that is marched coarsely."""
        scenes = [self.scene] if shown & OF_MOTION else []
        if "reference" in shown and scenes:
            scenes.append(self.grey.scene)
        if "ball_mass" in shown and not self.scene.bearing.kind.mass_unknown:
            scenes.append(self.scene.replace(balls=WITH_MASS))
        return any(map(self._is_coarse, scenes))

    def is_finer_at_rest(self, shown: frozenset[str]) -> bool:
        """True if any of these attributes is computed more finely once the slider rests."""
        return bool(shown & OVER_STRETCH) or self.is_coarse(shown)

    def _is_coarse(self, scene: Scene) -> bool:
        return self.moving and motions.is_costly(scene, self.settings.marching)

    def _marching_of(self, *scenes: Scene) -> Marching:
        """Settings of motions: coarse if one of them takes too long while a slider moves."""
        coarse = any(map(self._is_coarse, scenes))
        return self.settings.coarse_marching if coarse else self.settings.marching

    @cached_property
    def marching(self) -> Marching:
        """Settings of its motions; compared results share those of the scene on screen."""
        first = self.like or self
        how = first._marching_of(first.scene, first.grey.scene)
        if first.grey_kind == OTHER_BALLS and self.scene.balls == MASSLESS:
            return motions.match_bandwidth(self.scene, how)
        return how

    @cached_property
    def motion(self) -> Motion:
        """Simulated motion of rotor and housing."""
        return motions.motion(self.scene, self.marching).motion

    @property
    def fault(self) -> str:
        """Reason for an early end of the motion; empty without one."""
        return motions.ending(self.scene, self.marching).fault

    @property
    def doubt(self) -> str:
        """Words on bands of the spectrum that are not known within 1 dB; empty without them."""
        return motions.ending(self.scene, self.marching).doubt

    @cached_property
    def excerpt(self) -> Excerpt:
        """Some ball passes of the settled motion, with static loads for comparison."""
        return motions.excerpt(self.scene, self.marching)

    @cached_property
    def late_spectra(self) -> dict[str, Spectrum]:
        """Spectrum of the housing's acceleration along each direction, once the motion has settled.

        Empty if the motion did not stay finite.
        """
        return motions.late_spectra(self.scene, self.marching)

    @cached_property
    def peaks(self) -> dict[str, Peak]:
        """The highest line of the spectra along x and y, if the housing moves along them."""
        spectra = self.late_spectra
        return {dof: loudest(spectra[dof]) for dof in ("x", "y") if dof in spectra}

    @cached_property
    def ball_mass(self) -> BallMass:
        """The motions without and with the balls' mass, with the same settings."""
        if kind := self.scene.bearing.kind.mass_unknown:
            raise ValueError(f"the model has no mass of {kind}")
        how = self._marching_of(self.scene.replace(balls=WITH_MASS))
        return motions.ball_mass(self.scene.replace(balls=MASSLESS), how)

    @cached_property
    def contact_damping(self) -> float:
        """Viscous damping of a loaded contact [N·s/m], as set or from the stiffness."""
        compiling.need(compiling.STATICS, self.scene)
        return core.contact_damping(self.scene)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Effects that the model leaves out of the scene, with their numbers in motion.

        They do not depend on the views on screen: they have their own cage angles, and use a
        motion if any view has simulated it.
        """
        try:
            step_rate = motions.step_rate_of(self.scene, self.settings.sample_rate)
        except ValueError:
            step_rate = None  # there is no motion
        return endurance.limits(self.scene, step_rate, self.load_in_motion, self.life_inputs)

    @property
    def warnings(self) -> Warnings:
        return Warnings(verdict.rows_of(self.limits), summary(self.limits))

    @property
    def endurance(self) -> Endurance:
        """Life, pressure and film of the scene, with the oil and steel of `life_inputs`."""
        return endurance.endurance(self.scene, self.life_inputs)

    @property
    def load_in_motion(self) -> float | None:
        """Greatest ball load [N] of the settled motion; None if none has been simulated."""
        key = self.scene, self.settings.marching
        simulated = not self.moving and motions.motion.knows(*key)
        if not simulated and not motions.dynamic_load.knows(*key):
            return None
        load = motions.dynamic_load(*key)
        return load if math.isfinite(load) else None

    @cached_property
    def chain(self) -> Chain:
        """Results of each link from the loads of the balls to the vibration."""
        bands: dict[str, tuple[float, float]] = {}
        peaks: dict[str, Peak] = {}
        silent = ""
        try:
            bands = self.bands
            turns = self.scene.shaft_speed > 0.0
            peaks = self.peaks if turns else {}
            if not (turns and self.late_spectra):
                silent = why_ended(self.motion) if turns else "nothing turns"
        except StillCompiling:
            raise
        except ValueError as error:
            silent = str(error)
        return chain_of(self.ranges, self.scene, bands, peaks, silent)

    @property
    def picture_top(self) -> float:
        """Upper end [Hz] of a picture that shows all bands and highest lines."""
        ends = [peak.frequency for peak in self.peaks.values()]
        ends += [high for _, high in self.bands.values() if not math.isnan(high)]
        return 1.05 * max(ends, default=0.0)

    def chain_of(self, reference: Reference) -> Chain:
        """The chain of a reference; during a drag that of its beginning comes from the cache."""
        if reference.scene == self.scene:
            return self.chain
        return _chain_of(reference.scene, self.cage_angle, self.settings, self.moving)
