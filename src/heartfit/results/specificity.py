"""Comparison of two groups of hearts: ratios to the healthy mean and exact permutation tests."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from heartfit.calibration.gaussian import Gaussian, Information, information
from heartfit.calibration.update import long_steps
from heartfit.results.card import Card
from heartfit.results.case import Groups

ROUNDING = 1e-12
"""Relative rounding error of a sum."""


@dataclass(frozen=True)
class PermutationTest:
    """Difference of the means, first less second, and the shares of the labelings that are as extreme.

    p: as far from zero; less, greater: as small, as large. None can be below 1 / labelings, the share of the observed
    labeling. Reference: Fisher RA 1935, The Design of Experiments, section 21.
    """

    difference: float
    p: float
    less: float
    greater: float
    labelings: int


def permutation_test(first: Sequence[float], second: Sequence[float]) -> PermutationTest:
    """Return the exact test over all C(a + b, a) labelings; raises ValueError for an empty group."""
    if not (len(first) and len(second)):
        raise ValueError(
            f"permutation: groups of {len(first)} and {len(second)}; expected at least one member in each group"
        )
    values = np.array([*first, *second])
    differences = np.array(
        [_difference(values, chosen) for chosen in combinations(range(len(values)), len(first))]
    )
    observed, rounding = float(differences[0]), ROUNDING * np.abs(values).sum()
    return PermutationTest(
        observed,
        float((np.abs(differences) >= abs(observed) - rounding).mean()),
        float((differences <= observed + rounding).mean()),
        float((differences >= observed - rounding).mean()),
        len(differences),
    )


def _difference(values: np.ndarray, chosen: Sequence[int]) -> float:
    first = np.isin(np.arange(len(values)), chosen)
    return float(values[first].mean() - values[~first].mean())


STANDS_FOR = {"K": "c_1"}
"""Estimated and true parameter of the passive stiffness: K under linear tetrahedra, c_1 in the hidden hearts."""


def _noise_free(card: Card) -> dict[str, float]:
    return card.noise_free.estimate.physical()


def _noise_aware(card: Card) -> dict[str, float]:
    return card.noise_aware.estimate.physical()


def _unshrunk(card: Card) -> dict[str, float]:
    """Return X0 + A^+ (X_new - X0) in the informed directions: the estimate without the pull of the prior."""
    factor = np.linalg.cholesky(card.prior.covariance)
    change = np.linalg.solve(factor, card.noise_aware.estimate.mean - card.prior.mean)
    return card.prior.physical(card.prior.mean + factor @ card.information.unshrunk(change))


def _truth(card: Card) -> dict[str, float]:
    true = {name: card.truth.get(STANDS_FOR.get(name, name)) for name in card.prior.names}
    return {name: value for name, value in true.items() if value is not None}


READINGS: dict[str, Callable[[Card], dict[str, float]]] = {
    "noise-free": _noise_free,
    "noise-aware": _noise_aware,
    "unshrunk": _unshrunk,
    "truth": _truth,
}
"""Parameters of a case (SI by name): noise-free, noise-aware, without the pull of the prior, and true."""


@dataclass(frozen=True, eq=False)
class PatientComparison:
    """Patients and virtual volunteers of one setting."""

    setting: str
    volunteers: Sequence[Card]
    patients: Sequence[Card]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return the parameters that are estimated in all cases."""
        cards = [*self.volunteers, *self.patients]
        return tuple(
            name for name in self.volunteers[0].prior.names if all(name in card.prior.names for card in cards)
        )

    def ratios(self, reading: str, name: str) -> dict[str, float]:
        """Return a parameter of each case over the mean of the volunteers, by case; empty without a truth."""
        values = {card.case: READINGS[reading](card).get(name) for card in (*self.volunteers, *self.patients)}
        available = {case: value for case, value in values.items() if value is not None}
        healthy = [available[card.case] for card in self.volunteers if card.case in available]
        return {case: value / float(np.mean(healthy)) for case, value in available.items()} if healthy else {}

    def long_steps(self, reading: str, name: str) -> dict[str, float]:
        """Return the long steps of a parameter by case [prior standard deviations]; none of the truth."""
        if reading == "truth":
            return {}
        places = {
            card.case: float(np.log(READINGS[reading](card)[name] / card.prior.physical()[name]))
            / float(card.prior.marginal([name]).sd[0])
            for card in (*self.volunteers, *self.patients)
        }
        return long_steps(list(places), list(places.values()))

    def test(self, reading: str, name: str, patients: Sequence[str] | None = None) -> PermutationTest:
        """Return the exact test of ln parameter, patients (all, or those named) less volunteers."""
        logs = {case: float(np.log(ratio)) for case, ratio in self.ratios(reading, name).items()}
        chosen = [card.case for card in self.patients] if patients is None else patients
        return permutation_test(
            [logs[case] for case in chosen], [logs[card.case] for card in self.volunteers]
        )

    @cached_property
    def information(self) -> Information:
        """Return the information of the data on the difference of the two means.

        The covariance of the difference is sum C_i / k^2 over the k patients plus that over the volunteers, with
        posterior and with prior covariances.
        """
        prior = self.patients[0].prior.marginal(self.names)
        groups = (self.patients, self.volunteers)
        before = sum(1.0 / len(group) for group in groups)
        after = sum(
            card.noise_aware.estimate.marginal(self.names).covariance / len(group) ** 2
            for group in groups
            for card in group
        )
        return information(prior, Gaussian(self.names, prior.mean, np.asarray(after) / before))

    def difference(self, reading: str) -> np.ndarray:
        """Return the difference (n,) of the mean logarithms, patients less volunteers [prior sd]."""
        prior = self.patients[0].prior.marginal(self.names)
        differences = [self.test(reading, name).difference for name in self.names]
        return np.linalg.solve(np.linalg.cholesky(prior.covariance), differences)


def compare_groups(cards: Sequence[Card], groups: Groups) -> list[PatientComparison]:
    """Return one comparison per setting that has both volunteers and patients."""
    by_setting: Mapping[str, list[Card]] = {
        setting: [card for card in cards if card.setting == setting]
        for setting in dict.fromkeys(card.setting for card in cards)
    }
    comparisons = [
        PatientComparison(
            setting,
            [card for card in in_setting if card.case in groups.volunteers],
            [card for card in in_setting if card.case in groups.patients],
        )
        for setting, in_setting in by_setting.items()
    ]
    return [comparison for comparison in comparisons if comparison.volunteers and comparison.patients]
