"""The sphere forward model, and every mechanism as a hypothesis about it."""

from collections import Counter, OrderedDict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Protocol

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.parameter import Parameter, parameters_of
from heartfit.discovery.inference.data import Block
from heartfit.discovery.inference.hypothesis import Coordinate, Forward, Hypothesis
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS, TIME_SHIFT_INDEX
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart, perturb
from heartfit.discovery.sphere_model.recording import BALANCE
from heartfit.heart.beat import Beat
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.neighbours import Neighbours
from heartfit.heart.sphere.simulation import LimitCycle
from heartfit.roles import Mechanism, Sensor, registered
from heartfit.roles.sides import acts_within, right_excess

NUMERICS = Numerics(time_step=5e-3, max_beats=30, drift=1e-5)
"""Finite differences need a limit cycle: at a drift of 1 % beats differ by 1 mL and 0.3 kPa from it, here by 0.1 mL and
0.02 kPa at most."""

KEPT_CYCLES = 256
"""Number of limit cycles kept for hypotheses that differ by an instrument only, which does not change the beat."""


@dataclass(eq=False)
class SphereForwardModel:
    """Predictions of curves at their ``times`` [s after the trigger], by name.

    neighbours: hearts whose beats are simulated from that of their centre; None where every beat starts relaxed.
    centre: the heart of that centre without the effects, whose equal parts are kept.
    """

    nominal: NominalHeart
    times: Mapping[str, Floats]
    neighbours: Neighbours | None = None
    centre: Heart | None = None
    _cycles: "OrderedDict[bytes, LimitCycle | None]" = field(default_factory=OrderedDict)
    _counts: Counter[str] = field(default_factory=Counter)

    @classmethod
    def at_samples(cls, nominal: NominalHeart, blocks: Iterable[Block]) -> "SphereForwardModel":
        """Return the forward model of the samples of measured curves."""
        return cls(nominal, {block.curve: block.times for block in blocks})

    @cached_property
    def base(self) -> tuple[Coordinate, ...]:
        """Coordinates of the free parameters, which come first in every hypothesis."""
        return tuple(Coordinate(parameter.name) for parameter in self.nominal.free)

    @property
    def simulations(self) -> int:
        """Number of beats that were run; an instrument costs none."""
        return self._counts["beats"]

    def predict(self, x: Floats, effects: Sequence[Mechanism]) -> Floats | None:
        """The curves (n,) [SI], one after the other, at the coordinates x (b,); None where the simulation fails."""
        simulated = self.simulate(x, effects)
        if simulated is None:
            return None
        heart, beat = simulated
        return np.concatenate([observe_curve(beat, heart, name, times) for name, times in self.times.items()])

    def simulate(self, x: Floats, effects: Sequence[Mechanism] = ()) -> tuple[Heart, Beat] | None:
        """The heart at the coordinates x (b,) and its beat; None where the simulation fails."""
        try:
            nominal = self._perturb(x).with_mechanisms(effects)
            cycle = self._limit_cycle(nominal, x, effects)
        except ValueError:  # coordinates outside the range of a parameter
            return None
        if cycle is None or cycle.beat.volume["lv"].min() <= 0.0:
            return None
        return nominal.heart, cycle.beat

    def near(self, x: Floats, effects: Sequence[Mechanism]) -> "SphereForwardModel | None":
        """The forward model for hearts near the one at x (b,), whose beats start from that one's limit cycle.

        None where that heart has no limit cycle, or one that its neighbours do not start from.
        """
        perturbed = self._perturb(x)
        cycle = self._limit_cycle(perturbed.with_mechanisms(effects), x, effects)
        if cycle is None or cycle.heart.atria is not None:
            return None
        try:
            neighbours = Neighbours(cycle, NUMERICS)
        except StepFailed:
            return None
        return replace(self, neighbours=neighbours, centre=perturbed.heart, _cycles=OrderedDict())

    def _perturb(self, x: Floats) -> NominalHeart:
        return perturb(self.nominal, x, self.centre)

    def _limit_cycle(
        self, nominal: NominalHeart, x: Floats, effects: Sequence[Mechanism]
    ) -> LimitCycle | None:
        physical = [effect for effect in effects if not isinstance(effect, Sensor)]
        key = np.delete(x[: len(self.base)], TIME_SHIFT_INDEX).tobytes() + repr(physical).encode()
        if key in self._cycles:
            self._cycles.move_to_end(key)
            return self._cycles[key]
        self._counts["beats"] += 1
        self._cycles[key] = nominal.limit_cycle(NUMERICS, self.neighbours)
        if len(self._cycles) > KEPT_CYCLES:
            self._cycles.popitem(last=False)
        return self._cycles[key]


def observe_curve(beat: Beat, heart: Heart, name: str, times: Floats) -> Floats:
    """A curve of the beat (k,) [SI] through the heart's sensors at ``times`` (k,) [s after the trigger].

    The balance of both sides is one number: in a closed circulation the left atrium loses what its veins bring.
    """
    if name == BALANCE:
        return np.array([-right_excess(beat.flow, heart.mechanisms) * beat.period])
    start, values = beat.time[:-1] - heart.trigger, beat.signals()[name][:-1]
    for sensor in heart.sensors:
        if name in sensor.measures:
            values = sensor.distort(start, values, beat.period)
    return interpolate(np.mod(times - start[0], beat.period) / beat.period, values)


def interpolate(phases: Floats, values: Floats) -> Floats:
    """Interpolate equidistant samples (m,) of one period at ``phases`` (k,), 0 <= phase < 1.

    Cubic with the slopes of central differences: with straight lines the derivative by a delay would jump at every
    sample.
    """
    index, weight = _interpolation(phases.tobytes(), values.size)
    interpolated: Floats = np.einsum("ck,ck->k", weight, values[index])
    return interpolated


@lru_cache(maxsize=64)
def _interpolation(phases: bytes, count: int) -> tuple[Integers, Floats]:
    """Indices and weights (4, k) of the samples around each phase; kept, since hearts of a search share the phases."""
    place = np.frombuffer(phases) * count
    left = np.floor(place).astype(np.int64)
    u = place - left
    before, after = 0.5 * u * (u * (2.0 - u) - 1.0), 0.5 * u * u * (u - 1.0)
    own, right = 1.0 + 0.5 * u * u * (3.0 * u - 5.0), 0.5 * u * (1.0 + u * (4.0 - 3.0 * u))
    return (left + np.arange(-1, 3)[:, None]) % count, np.array([before, own, right, after])


BASE_COORDINATES = tuple(Coordinate(parameter.name) for parameter in FREE_PARAMETERS)
"""Coordinates of the free parameters of the left heart."""


@dataclass(frozen=True)
class Candidate:
    """A mechanism and its unknowns: the amplitude first, then all other parameters with a prior."""

    kind: type[Mechanism]
    unknowns: tuple[Parameter, ...]

    @classmethod
    def from_mechanism(cls, kind: type[Mechanism]) -> "Candidate":
        """The candidate of a mechanism of the registry."""
        switch = kind.switch()
        others = [
            parameter
            for parameter in parameters_of(kind)
            if parameter.name != switch.name and (parameter.sd is not None or parameter.scale is not None)
        ]
        return cls(kind, (switch, *others))

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self.kind.__name__

    def at(self, x: Floats) -> Mechanism:
        """The mechanism at its coordinates (k,); raises ValueError outside the range of a parameter."""
        values = {unknown.name: unknown.at(float(z)) for unknown, z in zip(self.unknowns, x, strict=True)}
        return self.kind(**values)

    def coordinates(self) -> tuple[Coordinate, ...]:
        """One for each unknown."""
        return tuple(
            Coordinate(f"{self.name}.{unknown.name}", unknown.one_sided, amplitude=unknown.off is not None)
            for unknown in self.unknowns
        )


def candidates(model: SphereForwardModel) -> dict[str, Candidate]:
    """All mechanisms that the nominal heart lacks and that act on a recorded curve, by name.

    Sensors are none of a heart that stands for a change: the same instruments have recorded both beats.
    """
    present = {type(mechanism) for mechanism in model.nominal.heart.mechanisms}
    sides = 1 if model.nominal.right is None else 2
    kinds = {
        name: kind for name, kind in registered().items() if kind not in present and acts_within(kind, sides)
    }
    if model.nominal.stands_for == "change":
        kinds = {name: kind for name, kind in kinds.items() if not issubclass(kind, Sensor)}
    return {
        name: Candidate.from_mechanism(kind)
        for name, kind in kinds.items()
        if _is_observable(kind, set(model.times))
    }


def _is_observable(kind: type[Mechanism], recorded: set[str]) -> bool:
    return kind.switch().scale is not None and (
        not issubclass(kind, Sensor) or bool(recorded & set(kind.measures))
    )


class ForwardModel(Protocol):
    """A model of a heart: base, the coordinates that every hypothesis shares, and predictions with effects.

    near: the model for hearts near one, from whose differences slopes follow; None where it is this model.
    """

    @property
    def base(self) -> tuple[Coordinate, ...]: ...
    def predict(self, x: Floats, effects: Sequence[Mechanism]) -> Floats | None: ...
    def near(self, x: Floats, effects: Sequence[Mechanism]) -> "ForwardModel | None": ...


Split = Callable[[Floats], tuple[Floats, Sequence[Mechanism]]]
"""The base coordinates (b,) and the effects at coordinates (d,); raises ValueError outside the range of a parameter."""


def hypothesis(model: ForwardModel, effects: Sequence[Candidate] = ()) -> Hypothesis:
    """The hypothesis of a heart with these mechanisms, all their unknowns free."""
    added = tuple(coordinate for effect in effects for coordinate in effect.coordinates())
    names = tuple(effect.name for effect in effects)
    ends = np.cumsum([len(model.base), *(len(effect.unknowns) for effect in effects)])

    def split(x: Floats) -> tuple[Floats, Sequence[Mechanism]]:
        base, *parts = np.split(x, ends[:-1])
        return base, [effect.at(part) for effect, part in zip(effects, parts, strict=True)]

    return model_hypothesis(model, names, added, split)


def model_hypothesis(
    model: ForwardModel, effects: tuple[str, ...], added: tuple[Coordinate, ...], split: Split
) -> Hypothesis:
    """The hypothesis that ``model`` predicts the data, with coordinates ``added`` to its own."""

    def near(x: Floats) -> Forward | None:
        neighbours = model.near(*split(x))
        return None if neighbours is None else _forward(neighbours, split)

    return Hypothesis(effects, model.base + added, _forward(model, split), near)


def _forward(model: ForwardModel, split: Split) -> Forward:
    def forward(x: Floats) -> Floats | None:
        try:
            return model.predict(*split(x))
        except ValueError:
            return None

    return forward
