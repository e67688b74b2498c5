"""Distance of a beat from the limit cycle, and the shifts of pressures that reduce it.

The drift of a beat, from its start to its end, measures its distance from the limit cycle. The time constant tau of a
Windkessel is longer than a beat, so plain repetition converges slowly: between beats its pressure is shifted to the
value that the stroke volume of the next beats will hold, as predicted from the last one or two beats.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.elements import Windkessel, WindkesselState

INITIAL_RESPONSES = 1.1, 1.0
"""Fall of the pressure deficit of the aorta and of the pulmonary artery per rise of the pressure at the start of a beat
[Pa/Pa], as a higher pressure also lowers the stroke volume. Initial guesses; after two beats it is measured."""

CREDIBLE_RESPONSES = 0.7, 4.0
"""Range of measured responses that are used; one outside it has another cause than the rise of the pressure."""

SURPLUS_FRACTION = 0.3
"""Excess of the stroke over later ones, as a fraction of the volume that the initially fuller ventricle lost."""


@dataclass(frozen=True, eq=False)
class Recurrence:
    """Cavity volumes (t, v) of a beat, and the states of the v Windkessels at its start and its end.

    ``atria`` (t, c) are the volumes of c atria that have one. In a ``closed`` circuit arteries fill veins.
    """

    volumes: Floats
    first: Sequence[WindkesselState]
    last: Sequence[WindkesselState]
    atria: Floats = field(default_factory=lambda: np.empty((1, 0)))
    closed: bool = False

    def drift(self) -> float:
        """Largest change over the beat: of volumes over stroke volume, and of Windkessel pressures over themselves."""
        in_volume = [*_relative_change(self.volumes), *_relative_change(self.atria)]
        in_pressure = [abs(b.P_c / a.P_c - 1.0) for a, b in zip(self.first, self.last, strict=True)]
        return float(max(*in_volume, *in_pressure))

    def responses(
        self,
        trees: Sequence[Windkessel],
        period: float,
        before: "Recurrence | None" = None,
        guesses: Sequence[float] = INITIAL_RESPONSES,
    ) -> list[float]:
        """Falls of the deficits per rise of the Windkessel pressures [Pa/Pa] since the beat ``before`` this one.

        The guess stands where there is no such beat, no credible measurement, or a closed circuit.
        """
        if before is None or self.closed:
            return list(guesses)
        earlier, deficits = before._deficits(trees, period), self._deficits(trees, period)
        rises = [new.P_c - old.P_c for new, old in zip(self.first, before.first, strict=True)]
        return list(map(_measured_response, earlier, deficits, rises, guesses))

    def shifts(
        self, trees: Sequence[Windkessel], period: float, responses: Sequence[float] = INITIAL_RESPONSES
    ) -> list[float]:
        """Rises [Pa] of the Windkessel pressures for the next beat, whose deficits fall by the ``responses``.

        They are zero in a closed circuit, in which a rise would create blood.
        """
        if self.closed:
            return [0.0] * len(trees)
        changes = [last.P_c - first.P_c for first, last in zip(self.first, self.last, strict=True)]
        return [
            deficit / response - change
            for deficit, response, change in zip(
                self._deficits(trees, period), responses, changes, strict=False
            )
        ]

    def _deficits(self, trees: Sequence[Windkessel], period: float) -> list[float]:
        surplus = SURPLUS_FRACTION * (self.volumes[0] - self.volumes[-1])
        sides = zip(trees, self.first, self.last, surplus.tolist(), strict=True)
        return [tree.pressure_deficit(first, last, period, volume) for tree, first, last, volume in sides]


def _relative_change(volumes: Floats) -> Floats:
    """Changes (v,) of volumes (t, v) over the beat, over their ranges."""
    result: Floats = np.abs(volumes[-1] - volumes[0]) / (volumes.max(axis=0) - volumes.min(axis=0))
    return result


def _measured_response(earlier: float, deficit: float, rise: float, guess: float) -> float:
    """Fall of the deficit per rise of the pressure, or ``guess`` where the measurement is not credible."""
    low, high = CREDIBLE_RESPONSES
    response = (earlier - deficit) / rise if rise else guess
    return response if low < response < high else guess
