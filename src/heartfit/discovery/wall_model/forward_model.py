r"""Predictions of measured curves, strain of the wall included, by a heart in three dimensions.

The measured wall at end diastole is unloaded for every heart anew. Curves follow from the beat on the limit cycle, as
those of the search on the sphere do; regional curves from its nodes at the times of the frames,

.. math:: f(x) = (V(t_i), P(t_j), E_s(t_k), d(t_k)),

with all image times counted from the trigger of that heart. Slopes by many unknowns come from one tangent-linear beat.
Reference and beat start from those of a heart before, which saves a beat and most of the unloading: the last one with
the same effects, otherwise the last one without any.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial, reduce
from operator import add

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.hypothesis import Coordinate
from heartfit.discovery.sphere_model.forward_model import interpolate, observe_curve
from heartfit.discovery.wall_model.unknowns import COORDINATES, NAMES, HeartInWall, heart_at
from heartfit.discovery.wall_model.wall_data import SEARCHED, WallRecording
from heartfit.geometry.fibres import FibreRule
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.heart.circulation.atria import chamber_table
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import FiniteElementBody, StepFailed
from heartfit.heart.finite_elements.neighbours import carry_state
from heartfit.heart.finite_elements.unloading import LoadedWall, unload
from heartfit.heart.heart import Heart
from heartfit.heart.neighbourhood import LoadedHeart, surround
from heartfit.heart.simulation import RESPONSES, Numerics, simulate
from heartfit.heart.tangent import differentiate, tangent_numerics
from heartfit.observation.regional import regional_curves
from heartfit.personalise.numerics import Pressures
from heartfit.roles import Mechanism, Sensor

NUMERICS = Numerics(time_step=5e-3, max_beats=8, drift=3e-3, keep_positions=True)
IMAGED, DISTORTED_PHASES = "lv_volume", 100
"""Curve by which an error of the images is known, and number of phases at which it distorts regional curves."""
STEP = 0.02
"""Distance of a neighbour [prior standard deviations]."""
HELICES = 4
"""Number of meshes with other helix angles that are kept."""


@dataclass(frozen=True, eq=False)
class _BeatEnd:
    """Ventricles at the end of a beat on the limit cycle, and the measured wall whose reference they have.

    responses: of the Windkessels, see :meth:`Recurrence.responses`.
    """

    wall: LoadedWall
    body: FiniteElementBody
    state: HeartState
    responses: tuple[float, ...]

    def carried_to(self, heart: Heart, body: FiniteElementBody) -> HeartState | None:
        """State at which the beats of another heart begin, the nodes and pressures kept, the blood in valves at rest.

        None where an atrium has a volume, since the blood of the circuit may differ.
        """
        if self.state.atria is not None or chamber_table(heart.mechanisms) is not None:
            return None
        carry = partial(carry_state, body=self.body, other=body)
        return replace(self.state.with_walls(carry), branches=None)


@dataclass(eq=False)
class WallForwardModel:
    """Model of one measured wall.

    mesh: the wall at end diastole, prepared and activated; nominal: the heart at the prior mean; times: of every
    curve [s after the trigger], by name; frames (p,): times of the images [s], the first one the reference of strain.
    simulations: number of beats that were run, ``tangents``: of tangent-linear ones.
    """

    mesh: VentricularMesh
    nominal: HeartInWall
    times: Mapping[str, Floats]
    frames: Floats
    numerics: Numerics = NUMERICS
    simulations: int = 0
    tangents: int = 0
    _before: dict[tuple[str, ...], _BeatEnd] = field(default_factory=dict, init=False, repr=False)

    @classmethod
    def at_samples(
        cls, recording: WallRecording, heart: Heart, pressures: Pressures, numerics: Numerics = NUMERICS
    ) -> "WallForwardModel":
        """The model of the wall of a recording at all of its samples, with the end-diastolic ``pressures``."""
        nominal = HeartInWall.loaded(heart, pressures.lv, pressures.rv)
        times = {block.curve: block.times for block in recording.data().blocks}
        return cls(recording.mesh, nominal, times, recording.frames, numerics)

    def with_long_steps(self) -> "WallForwardModel":
        """The model with the time step of derivatives; its first beats start from those of this model."""
        longer = replace(self, numerics=tangent_numerics(self.numerics), simulations=0, tangents=0)
        longer._before = self._before
        return longer

    @property
    def base(self) -> tuple[Coordinate, ...]:
        """Coordinates of the unknowns, which come first in every hypothesis."""
        return COORDINATES

    @cached_property
    def regional(self) -> tuple[str, ...]:
        """Names of the regional curves."""
        return tuple(name for name in self.times if name in SEARCHED)

    def predict(self, x: Floats, effects: Sequence[Mechanism] = ()) -> Floats | None:
        """The curves (n,) [SI], one after the other, at the coordinates x (b,); None where the simulation fails."""
        self.simulations += 1
        try:
            placed = self._heart_at(x, effects)
            beat = self._beat(placed, tuple(type(effect).__name__ for effect in effects))
        except (ValueError, StepFailed):  # outside the range of a parameter, or no stress-free wall
            return None
        return self.observe(beat, placed.heart) if beat.completed else None

    def near(self, x: Floats, effects: Sequence[Mechanism] = ()) -> None:
        """No other model: its slopes are those of tangent beats, or differences of its predictions."""

    def observe(self, beat: Beat, heart: Heart) -> Floats:
        """The curves (n,) [SI] of a beat that kept its nodes, through the sensors of the heart."""
        regional = self._regional_curves(beat, heart) if self.regional else {}
        return np.concatenate(
            [
                regional[name] if name in regional else observe_curve(beat, heart, name, times)
                for name, times in self.times.items()
            ]
        )

    def _regional_curves(self, beat: Beat, heart: Heart) -> dict[str, Floats]:
        """Regional curves at the frames after the first, through the errors of the images, which distort motion."""
        acting = [sensor for sensor in heart.sensors if IMAGED in sensor.measures]
        phases = beat.period * np.arange(DISTORTED_PHASES) / DISTORTED_PHASES
        times, motion = (phases if acting else self.frames), nodal_motion(beat)
        imaged = Motion(times, beat.period, np.array([motion.at(time) for time in times]))
        curves = {name: curve.values for name, curve in regional_curves(self.mesh, imaged).items()}
        if not acting:
            return {name: curves[name][1:] for name in self.regional}
        return {name: self._distorted(curves[name], times, beat.period, acting) for name in self.regional}

    def _distorted(self, values: Floats, times: Floats, period: float, acting: Sequence[Sensor]) -> Floats:
        """Values at the frames after the first, of which the first one is the reference again."""
        for sensor in acting:
            values = sensor.distort(times, values, period)
        at_frames = interpolate(np.mod(self.frames, period) / period, values)
        return at_frames[1:] - at_frames[0]

    def slopes(self, x: Floats, effects: Sequence[Mechanism] = ()) -> tuple[Floats, Floats] | None:
        """Prediction (n,) and its derivatives (n, b) by the unknowns that all hypotheses share; None on failure."""
        predicted = self.predict(x, effects)
        if predicted is None:
            return None
        try:
            return predicted, self._differentiate(x, effects)
        except (ValueError, StepFailed):
            return None

    def _differentiate(self, x: Floats, effects: Sequence[Mechanism]) -> Floats:
        steps = STEP * np.eye(len(NAMES))
        centre, *others = (
            self._measured(self._heart_at(x[: len(NAMES)] + step, effects)) for step in (0.0, *steps)
        )
        body, neighbours = surround(centre, others, STEP)
        self.tangents += 1
        tangent = differentiate(centre.heart, body, neighbours, tangent_numerics(self.numerics))
        observed = self.observe(tangent.beat, centre.heart)
        columns = [
            (self.observe(tangent.near(index), other.heart) - observed) / STEP
            for index, other in enumerate(others)
        ]
        return np.column_stack(columns)

    def _heart_at(self, x: Floats, effects: Sequence[Mechanism]) -> HeartInWall:
        placed = heart_at(self.nominal, x)
        return replace(placed, heart=reduce(add, effects, placed.heart))

    def _beat(self, placed: HeartInWall, effects: tuple[str, ...]) -> Beat:
        """The beat on the limit cycle, from the end of one before; from relaxed ventricles if that one fails."""
        near = self._before.get(effects, self._before.get(()))
        wall = self._measured(placed).wall
        body = _unloaded_body(wall, near)
        history: list[HeartState] = []
        run = partial(simulate, placed.heart, body, self.numerics, watch=history.extend)
        start = None if near is None else near.carried_to(placed.heart, body)
        beat = run() if near is None or start is None else run(start=start, responses=near.responses)
        if start is not None and not beat.completed:
            beat = run()
        if beat.completed:
            others = {(): self._before[()]} if () in self._before else {}
            responses = tuple(beat.diagnostics[name] for name in RESPONSES)
            self._before = others | {effects: _BeatEnd(wall, body, history[-1], responses)}
        return beat

    def _measured(self, placed: HeartInWall) -> LoadedHeart:
        """A heart in the measured wall, with its helix angles."""
        return LoadedHeart(placed.heart, self._turned(*placed.helix), placed.loads)

    @cached_property
    def _turned(self) -> Callable[[float, float], VentricularMesh]:
        """The mesh by the changes of its helix angles [rad]; most hearts that follow one another share it."""
        return lru_cache(HELICES)(partial(_with_helix, self.mesh, FibreRule.from_mesh(self.mesh)))


def _with_helix(mesh: VentricularMesh, rule: FibreRule, endo: float, epi: float) -> VentricularMesh:
    """The mesh with fibres by a rule whose helix angles are changed [rad]."""
    if endo == epi == 0.0:
        return mesh
    turned = replace(rule, endo=rule.endo + endo, epi=rule.epi + epi)
    return replace(mesh, fibres=turned.fibres(), orientation=turned.orientation())


def _unloaded_body(wall: LoadedWall, near: _BeatEnd | None) -> FiniteElementBody:
    """Ventricles on the stress-free reference of a wall, that of a body before where both rest alike."""
    if near is None:
        return FiniteElementBody(unload(wall.mesh, wall.tissue, wall.pressures), wall.tissue)
    reference = near.body.reference
    if not wall.rests_like(near.wall):
        reference = unload(wall.mesh, wall.tissue, wall.pressures, reference)
    return FiniteElementBody(reference, wall.tissue, near.body.elimination)
