"""What a calibration says of one case: the record behind its card."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.information import Information, information
from heartfit.calibration.update import Posterior
from heartfit.tables.evaluation import comparable

REACH = 1.96
"""Standard deviations on either side that hold 95 %."""

LOUD, NAMED = 0.35, 3
"""Share of its largest component from which another one of a direction is named, and how many are at most."""


@dataclass(frozen=True, eq=False)
class Card:
    """Two posteriors of the same beats: met (as the paper, R = 0 unless the study says otherwise) and weighed.

    The latter knows the noise of the observations and the uncertainty of what is held fixed. truth: SI by name, empty
    of a measured heart.
    """

    case: str
    setting: str
    met: Posterior
    weighed: Posterior
    truth: Mapping[str, float]

    @property
    def prior(self) -> Gaussian:
        """Of both."""
        return self.met.prior

    @cached_property
    def seen(self) -> Information:
        """What the data inform, noise and fixed parameters taken into account."""
        return information(self.prior, self.weighed.estimate)

    def place(self, estimate: Gaussian) -> np.ndarray:
        """Where the mean of an estimate lies (n,), in prior standard deviations from the prior's."""
        return (estimate.mean - self.prior.mean) / self.prior.sd

    def true_place(self) -> np.ndarray:
        """The same of the truth, NaN where there is none."""
        true = [np.log(self.truth[name]) if name in self.truth else np.nan for name in self.prior.names]
        return (np.array(true) - self.prior.mean) / self.prior.sd

    def covered(self, estimate: Gaussian) -> dict[str, bool]:
        """Whether the 95 % interval of each parameter that has a truth holds it."""
        off = np.abs(self.place(estimate) - self.true_place()) * self.prior.sd / estimate.sd
        return {
            name: bool(z <= REACH) for name, z in zip(self.prior.names, off, strict=True) if np.isfinite(z)
        }

    def weakest(self) -> str:
        """The direction of which the data say least, as "sigma_0 up with R_p up"."""
        direction = self.seen.weakest
        loud = np.flatnonzero(np.abs(direction) >= LOUD * np.abs(direction).max())
        named = sorted(loud, key=lambda place: -abs(direction[place]))[:NAMED]
        return " with ".join(f"{self.prior.names[i]} {'up' if direction[i] > 0 else 'down'}" for i in named)


def cards(
    keys: Iterable[tuple[str, str]],
    met: Iterable[Posterior],
    weighed: Iterable[Posterior],
    truths: Mapping[str, Mapping[str, float]],
) -> Sequence[Card]:
    """One card per case and setting, in the order of the keys (case, setting)."""
    return [
        Card(case, setting, bare, noisy, comparable(truths.get(case, {})))
        for (case, setting), bare, noisy in zip(keys, met, weighed, strict=True)
    ]
