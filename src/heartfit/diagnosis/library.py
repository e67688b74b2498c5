"""Every mechanism of the folder as a hypothesis: one that is dropped there is a candidate here."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.free import FREE
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.hypothesis import Coordinate, Hypothesis
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Mechanism, Sensor, registered
from heartfit.parameter import Parameter, parameters_of

BASE = tuple(Coordinate(each.name) for each in FREE)


@dataclass(frozen=True)
class Candidate:
    """A mechanism and what is unknown of it: its amplitude first, then whatever else has a prior."""

    kind: type[Mechanism]
    unknowns: tuple[Parameter, ...]

    @classmethod
    def of(cls, kind: type[Mechanism]) -> "Candidate":
        switch = kind.switch()
        others = [each for each in parameters_of(kind) if each.name != switch.name]
        return cls(
            kind, (switch, *(each for each in others if each.sd is not None or each.scale is not None))
        )

    @property
    def name(self) -> str:
        return self.kind.__name__

    def at(self, x: Floats) -> Mechanism:
        """The mechanism at its coordinates (k,); raises ValueError where they make no sense."""
        values = {each.name: each.at(float(z)) for each, z in zip(self.unknowns, x, strict=True)}
        return self.kind(**values)

    def coordinates(self) -> tuple[Coordinate, ...]:
        """One for each unknown."""
        return tuple(
            Coordinate(f"{self.name}.{each.name}", each.one_sided, amplitude=each.off is not None)
            for each in self.unknowns
        )


def candidates(twin: Twin) -> dict[str, Candidate]:
    """All mechanisms that the centre's heart has not and that act on what is recorded, by name."""
    had = {type(each) for each in twin.centre.heart.mechanisms}
    kinds = {name: kind for name, kind in registered().items() if kind not in had}
    return {name: Candidate.of(kind) for name, kind in kinds.items() if _acts(kind, set(twin.times))}


def _acts(kind: type[Mechanism], recorded: set[str]) -> bool:
    return kind.switch().scale is not None and (
        not issubclass(kind, Sensor) or bool(recorded & set(kind.measures))
    )


def hypothesis(twin: Twin, effects: Sequence[Candidate] = ()) -> Hypothesis:
    """A heart with these mechanisms, everything unknown of it free."""
    coordinates = BASE + tuple(each for effect in effects for each in effect.coordinates())
    return Hypothesis(tuple(each.name for each in effects), coordinates, _forward(twin, effects))


def _forward(twin: Twin, effects: Sequence[Candidate]) -> Callable[[Floats], Floats | None]:
    ends = np.cumsum([len(BASE), *(len(effect.unknowns) for effect in effects)])

    def forward(x: Floats) -> Floats | None:
        parts = np.split(x, ends[:-1])[1:]
        try:
            mechanisms = [effect.at(part) for effect, part in zip(effects, parts, strict=True)]
        except ValueError:
            return None
        return twin.predicted(x, mechanisms)

    return forward
