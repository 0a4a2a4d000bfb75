"""Results: what is known about one scene, computed when first asked for.

Everything that is drawn passes through here. What is costly is
computed by the functions of `statics`, `motion` and `endurance`, whose results all sessions share.
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
"""Greatest extents of maps [rad]: the first that holds the extent shown. 90° as in the paper."""

OF_MOTION = frozenset({"motion", "excerpt", "late_spectra", "ball_mass", "chain"})
"""Attributes of `Results` that are made of a simulated motion, and are drawn after the others."""
OVER_STRETCH = frozenset({"equilibrium", "ranges", "modes", "bands", "chain"})
"""Attributes over the cage angles of the curves, fewer while a slider moves."""


@cached
def _chain_of(scene: Scene, cage_angle: float, settings: Settings, moving: bool) -> Chain:
    """The chain of another scene: a whole drag is compared with the one where it began."""
    return Results(scene, cage_angle, settings, moving=moving).chain


@dataclass(frozen=True, eq=False)
class Results(SceneContent):
    """All that the views read. Attributes are computed when first asked for, in any thread.

    Parameters
    ----------
    scene
        the scene shown.
    cage_angle
        [rad] shown.
    settings
        fineness of the computation.
    focus
        number of the defect that is looked at.
    moving
        whether a slider moves, so that a quick answer is wanted.
    held
        whether a hand still holds a slider or handle: the scales that it measures by stay.
    compared
        scenes that are drawn too, each under a name.
    before
        the scene before the last change, where there was one.
    grey_kind
        kind of the reference that is drawn in grey.
    life_inputs
        steel, oil and surfaces as entered under Life.
    lesson_term
        term of the stiffness that the open lesson compares between scenes; empty without one.
    mark
        number of the newest change of the browser that they hold.
    like
        other results, over whose stretch and with whose steps these are computed.
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
        """All that a fine picture depends on: turning the bearing leaves one fine."""
        return self.scene, self.settings, self.compared, self.grey_kind

    def against(self, reference: Reference, *, own_period: bool = False) -> Results:
        """Results of another scene, to be compared with these.

        Over the cage angles and with the steps of these, or over its `own_period` with its own.
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
        """Controls with this scene, for forms outside of the page."""
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
        """Results of that."""
        return self.against(self.grey)

    @property
    def over_shaft(self) -> bool:
        """True if curves are drawn over a turn of the shaft: a defect turns with it."""
        return self.scene.defect_turns

    @cached_property
    def stretch(self) -> tuple[float, float, int]:
        """First and last cage angle [rad] that curves are drawn over, and how many there are.

        A ball spacing, after which all is as before; of rows of unlike balls what their spacings
        have in common, or a turn of the cage. With a defect of the inner race nothing repeats so
        soon: then the turn of the shaft that the cage angle shown lies in.
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
        """Cage angles [rad] as curves show them [degrees], within the stretch.

        Those of the cage, or where the curves are over a turn of the shaft, those of the shaft.
        """
        first, last, _ = self.stretch
        angle = np.asarray(cage_angle, dtype=float)
        inside = first + np.where(angle == last, last - first, (angle - first) % (last - first))
        if self.over_shaft:
            return 360.0 * (inside - first) / (last - first)
        return np.degrees(inside)

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """Static answers over the stretch."""
        return statics.curves(self.scene, *self.stretch)

    @cached_property
    def ranges(self) -> StaticRanges:
        """Least, greatest and mean of static answers, over all positions of the bearing.

        Where a defect turns with the shaft they are more than the turn that curves are over.
        """
        if self.over_shaft or (self.like is not None and self.like.over_shaft):
            return statics.ranges(self.scene, self.moving)
        return ranges_of(self.equilibrium)

    @cached_property
    def load_curves(self) -> list[Curve]:
        """Load [N] of a ball over its angle [rad], a curve a row; see `load_curve`."""
        rows = range(len(self.scene.bearing.all_rows))
        return [load_curve(self.ranges.state, row) for row in rows]

    @cached_property
    def inner_load_curves(self) -> list[Curve]:
        """Load curves at the inner race, where balls with mass carry less; else none."""
        state = self.ranges.state
        if not isinstance(state, EquilibriumWithMass) or state.positions.centrifugal_load == 0.0:
            return []
        rows = range(len(state.scene.bearing.all_rows))
        return [load_curve(state, row, state.inner_load) for row in rows]

    @cached_property
    def now(self) -> Equilibrium:
        """Static answer at the cage angle shown; arrays of length 1."""
        return statics.curves(self.scene, self.cage_angle, self.cage_angle, 1)

    @cached_property
    def modes(self) -> Modes:
        """Natural frequencies over the stretch."""
        return statics.modes(self.scene, *self.stretch)

    @cached_property
    def bands(self) -> dict[str, tuple[float, float]]:
        """Least and greatest frequency [Hz] of each mode over all positions of the bearing.

        Looked for between the angles too, and in all turns of the shaft: the same however finely
        curves are drawn. Coarser while a slider moves.
        """
        return statics.bands(self.scene, self.moving)

    @property
    def extent(self) -> float:
        """Extent [rad] of the defect that is looked at."""
        return defects_of(self.scene)[self.focus].extent

    @cached_property
    def maps(self) -> Maps:
        """Stiffness and loaded balls over extents of the defect looked at, and cage angles.

        The same maps for every extent that they hold: moving along them computes nothing.
        """
        first, last, _ = self.stretch
        others = list(defects_of(self.scene))
        looked_at = dataclasses.replace(others.pop(self.focus), extent=0.0)
        scene = self.scene.replace(defect=(looked_at, *others) if others else looked_at)
        reach = next(reach for reach in MAP_REACHES if self.extent <= reach * 1.000001)
        # a turn of the shaft holds about five ball spacings: twice the angles, or too much to send
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
        """Begin in another thread what of these attributes can be computed at the same time."""
        if {"late_spectra", "reference"} <= needed:
            key = self.grey.scene, self.reference.marching
            if not motions.late_spectra.knows(*key):  # the picture waits for this one
                PICTURES.submit(motions.late_spectra, *key)

    def status(self, seconds: float, needed: frozenset[str] = frozenset()) -> dict[str, Any]:
        """The status line of results that took `seconds` [s], for views that need these."""
        mood, words = self.verdict(needed)
        details = verdict.details_of(self.equilibrium)
        if self.is_coarse(needed):
            details.append("coarse while it moves: a shorter motion, in fewer steps")
        details.append(f"{1e3 * seconds:.1f} ms of computing")
        return {"mood": mood, "words": words, "details": details, "resting": not self.moving}

    def verdict(self, shown: frozenset[str]) -> Verdict:
        """The verdict on what is on screen: `shown` are the attributes that its views read.

        The first failure counts: without a static state there is no motion.
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
        """Arguments of a figure that needs these attributes, where they are not as usual."""
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
        """The argument of a figure that draws compared scenes; none without them."""
        named = (f"{code_of(other.name)}: {scene_code(other.scene)}" for other in self.compared)
        return {"compared": "{" + ", ".join(named) + "}"} if self.compared else {}

    def is_coarse(self, shown: frozenset[str]) -> bool:
        """True if what is shown of attributes is made of motions that are marched coarsely."""
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
        """Settings of motions: coarse where one of them takes too long while a slider moves."""
        coarse = any(map(self._is_coarse, scenes))
        return self.settings.coarse_marching if coarse else self.settings.marching

    @cached_property
    def marching(self) -> Marching:
        """Settings of its motions; those of the scene with the defect where it is compared."""
        first = self.like or self
        how = first._marching_of(first.scene, first.grey.scene)
        if first.grey_kind == OTHER_BALLS and self.scene.balls == MASSLESS:
            return motions.limit_to_known(self.scene, how)
        return how

    @cached_property
    def motion(self) -> Motion:
        """Simulated motion of rotor and housing."""
        return motions.motion(self.scene, self.marching).motion

    @property
    def fault(self) -> str:
        """Reason for an early end of the motion; empty where there is none."""
        return motions.ending(self.scene, self.marching).fault

    @property
    def doubt(self) -> str:
        """Words on bands of the spectrum that are not known within 1 dB; or empty."""
        return motions.ending(self.scene, self.marching).doubt

    @cached_property
    def excerpt(self) -> Excerpt:
        """Some ball passes of the settled motion, with static loads for comparison."""
        return motions.excerpt(self.scene, self.marching)

    @cached_property
    def late_spectra(self) -> dict[str, Spectrum]:
        """Spectrum of the housing's acceleration along each direction, once the motion has settled.

        Empty where it did not stay finite.
        """
        return motions.late_spectra(self.scene, self.marching)

    @cached_property
    def peaks(self) -> dict[str, Peak]:
        """The highest lines of these spectra along x and y, where the housing moves along them."""
        spectra = self.late_spectra
        return {dof: loudest(spectra[dof]) for dof in ("x", "y") if dof in spectra}

    @cached_property
    def ball_mass(self) -> BallMass:
        """The motions without and with the balls' mass, marched alike, for any scene."""
        if kind := self.scene.bearing.kind.mass_unknown:
            raise ValueError(f"the model has no mass of {kind}")
        how = self._marching_of(self.scene.replace(balls=WITH_MASS))
        return motions.ball_mass(self.scene.replace(balls=MASSLESS), how)

    @cached_property
    def contact_damping(self) -> float:
        """Viscous damping of a loaded contact [N·s/m], given or from the stiffness."""
        compiling.need(compiling.STATICS, self.scene)
        return core.contact_damping(self.scene)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Effects that the model leaves out of the scene, with their numbers in motion.

        The same whatever is on screen: looked at over cage angles of its own, and with the motion
        that any view has had simulated.
        """
        try:
            step_rate = motions.step_rate_of(self.scene, self.settings.sample_rate)
        except ValueError:
            step_rate = None  # no motion, no steps
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
        """Greatest ball load [N] of the settled motion, where one has been simulated."""
        key = self.scene, self.settings.marching
        simulated = not self.moving and motions.motion.knows(*key)
        if not simulated and not motions.dynamic_load.knows(*key):
            return None
        load = motions.dynamic_load(*key)
        return load if math.isfinite(load) else None

    @cached_property
    def chain(self) -> Chain:
        """Results from the loads of the balls to the vibration."""
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
        """The frequency [Hz] up to which bands and highest lines are: a picture shows all."""
        ends = [peak.frequency for peak in self.peaks.values()]
        ends += [high for _, high in self.bands.values() if not math.isnan(high)]
        return 1.05 * max(ends, default=0.0)

    def chain_of(self, reference: Reference) -> Chain:
        """The chain of a reference; while a drag is compared with its beginning it is looked up."""
        if reference.scene == self.scene:
            return self.chain
        return _chain_of(reference.scene, self.cage_angle, self.settings, self.moving)
