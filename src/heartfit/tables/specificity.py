"""Whether patients differ from volunteers, as estimated, without the pull of the prior, and in truth."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.information import Information, information
from heartfit.calibration.permutation import PermutationTest, permutation_test
from heartfit.tables.card import Card
from heartfit.tables.groups import Groups

STANDS_FOR = {"K": "c_1"}
"""Under linear tetrahedra K stands for the passive stiffness, which in the hidden hearts is c_1."""


def _met(card: Card) -> dict[str, float]:
    return card.met.estimate.physical()


def _weighed(card: Card) -> dict[str, float]:
    return card.weighed.estimate.physical()


def _unshrunk(card: Card) -> dict[str, float]:
    """X0 + A^+ (X_new - X0) over what is informed: what the data ask for, undone what the prior holds back."""
    factor = np.linalg.cholesky(card.prior.covariance)
    change = np.linalg.solve(factor, card.weighed.estimate.mean - card.prior.mean)
    return card.prior.physical(card.prior.mean + factor @ card.seen.unshrunk(change))


def _truth(card: Card) -> dict[str, float]:
    true = {name: card.truth.get(STANDS_FOR.get(name, name)) for name in card.prior.names}
    return {name: value for name, value in true.items() if value is not None}


READINGS: dict[str, Callable[[Card], dict[str, float]]] = {
    "observations met": _met,
    "noise and fixed": _weighed,
    "unshrunk": _unshrunk,
    "truth": _truth,
}
"""Parameters of a case, SI by name, as the paper reads them, weighed, without the prior's pull, and as they are."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """The patients and the virtual volunteers of one setting."""

    setting: str
    volunteers: Sequence[Card]
    patients: Sequence[Card]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The parameters that are estimated in everybody."""
        everybody = [*self.volunteers, *self.patients]
        return tuple(
            name for name in self.volunteers[0].prior.names if all(name in c.prior.names for c in everybody)
        )

    def ratios(self, reading: str, name: str) -> dict[str, float]:
        """A parameter of each case over the mean of the volunteers, by case; empty where a truth is not known."""
        values = {card.case: READINGS[reading](card).get(name) for card in (*self.volunteers, *self.patients)}
        known = {case: value for case, value in values.items() if value is not None}
        healthy = [known[card.case] for card in self.volunteers if card.case in known]
        return {case: value / float(np.mean(healthy)) for case, value in known.items()} if healthy else {}

    def test(self, reading: str, name: str, patients: Sequence[str] | None = None) -> PermutationTest:
        """The exact test of ln of a parameter, patients (all, or those named) less volunteers."""
        logs = {case: float(np.log(ratio)) for case, ratio in self.ratios(reading, name).items()}
        chosen = [card.case for card in self.patients] if patients is None else patients
        return permutation_test(
            [logs[case] for case in chosen], [logs[card.case] for card in self.volunteers]
        )

    @cached_property
    def seen(self) -> Information:
        """What the data inform of the difference of the two means.

        Its covariance is sum C_i / k^2 over the k patients plus that over the volunteers, after the data and before.
        """
        prior = self.patients[0].prior.marginal(self.names)
        groups = (self.patients, self.volunteers)
        before = sum(1.0 / len(group) for group in groups)
        after = sum(
            card.weighed.estimate.marginal(self.names).covariance / len(group) ** 2
            for group in groups
            for card in group
        )
        return information(prior, Gaussian(self.names, prior.mean, np.asarray(after) / before))

    def difference(self, reading: str) -> np.ndarray:
        """Difference of the mean logarithms, patients less volunteers, in prior standard deviations (n,)."""
        prior = self.patients[0].prior.marginal(self.names)
        found = [self.test(reading, name).difference for name in self.names]
        return np.linalg.solve(np.linalg.cholesky(prior.covariance), found)


def comparisons(cards: Sequence[Card], groups: Groups) -> list[Comparison]:
    """One comparison per setting that has both volunteers and patients."""
    by_setting: Mapping[str, list[Card]] = {
        setting: [card for card in cards if card.setting == setting]
        for setting in dict.fromkeys(c.setting for c in cards)
    }
    found = [
        Comparison(
            setting,
            [card for card in of if card.case in groups.volunteers],
            [card for card in of if card.case in groups.patients],
        )
        for setting, of in by_setting.items()
    ]
    return [each for each in found if each.volunteers and each.patients]
