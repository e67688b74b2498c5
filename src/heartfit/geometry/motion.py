"""A mesh that is carried through the beat."""

from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats

FEWEST_PHASES = 8


@dataclass(frozen=True, eq=False)
class Motion:
    """The same mesh in every phase of one beat; phase 0 is end diastole, at the trigger of the ECG.

    times (p,) s, within one period; period s; positions (p,n,3) m.
    Raises InputError for fewer than 8 phases, times that do not increase or leave the period, and NaN.
    """

    times: Floats
    period: float
    positions: Floats

    def __post_init__(self) -> None:
        require_phases(len(self.times), "motion")
        if self.positions.shape != (len(self.times), self.positions.shape[1], 3):
            raise InputError(
                f"motion: positions {self.positions.shape}, expected ({len(self.times)}, nodes, 3)"
            )
        if not (np.isfinite(self.times).all() and np.isfinite(self.positions).all()):
            raise InputError("motion: holds NaN or infinite times or positions; expected finite numbers")
        if not (np.diff(self.times) > 0.0).all():
            late = int(np.argmax(np.diff(self.times) <= 0.0)) + 1
            raise InputError(
                f"motion: phase {late} is at {self.times[late]:g} s; expected later than phase {late - 1}"
            )
        if self.times[0] < 0.0 or self.times[-1] >= self.period:
            raise InputError(
                f"motion: times run from {self.times[0]:g} to {self.times[-1]:g} s; "
                f"expected within [0, {self.period:g}) s"
            )

    def at(self, time: float) -> Floats:
        """Positions (n,3) m at any time, s, periodic and linear between the phases."""
        after = int(np.searchsorted(self.times, time % self.period, side="right"))
        before, span = after - 1, np.append(self.times, self.times[0] + self.period)
        start = span[before] if after else self.times[-1] - self.period
        share = (time % self.period - start) / (span[after] - start)
        later = self.positions[after % len(self.times)]
        place: Floats = (1.0 - share) * self.positions[before] + share * later
        return place

    def sampled(self, times: Floats) -> "Motion":
        """The motion at other times (q,), s."""
        return Motion(times, self.period, np.array([self.at(time) for time in times]))


def require_phases(count: int, where: str) -> None:
    """Raises InputError when there are too few phases to see filling and ejection."""
    if count < FEWEST_PHASES:
        raise InputError(
            f"{where}: {count} phases; expected at least {FEWEST_PHASES}; measure the whole beat"
        )
