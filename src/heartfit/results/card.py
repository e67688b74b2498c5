"""Card of a case: posteriors, informed directions, and coverage of the truth by intervals."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from heartfit.calibration.gaussian import Gaussian, Information, information
from heartfit.calibration.update import Posterior, long_steps
from heartfit.observation.noise_model import Share
from heartfit.results.case import CaseResult, relative_errors
from heartfit.results.text import LONG_STEPS

WITHOUT_TRUTH = ("K",)
"""K acts only through the locking of linear tetrahedra; the hidden heart, on another element, has no true K."""


def comparable_truth(truth: Mapping[str, float]) -> dict[str, float]:
    """Return the true parameters that an estimate can be compared with."""
    return {name: value for name, value in truth.items() if name not in WITHOUT_TRUTH}


def truth_errors(case: CaseResult, truth: Mapping[str, float]) -> dict[str, float]:
    """Return the signed relative error [%] of each estimated parameter with a truth; truth: SI by name."""
    true_values = comparable_truth(truth)
    return relative_errors(
        case.estimate, {name: true_values[name] for name in case.estimate if name in true_values}
    )


INTERVAL_REACH = 1.96
"""Half width of the 95 % interval of a Gaussian [standard deviations]."""

NAMED_SHARE, MOST_NAMED = 0.35, 3
"""Least component of a named parameter over the largest of its direction, and largest number of named parameters."""


@dataclass(frozen=True, eq=False)
class Card:
    """Noise-free and noise-aware posterior of the same beats.

    noise_free: as in the paper (R = 0 unless the study sets another); noise_aware: R is the noise of the observations
    plus the uncertainty of fixed parameters. truth: SI by name, empty for a measured heart.
    """

    case: str
    setting: str
    noise_free: Posterior
    noise_aware: Posterior
    truth: Mapping[str, float]

    @property
    def prior(self) -> Gaussian:
        """Return the prior of both posteriors."""
        return self.noise_free.prior

    @cached_property
    def information(self) -> Information:
        """Return the information of the data, with noise and fixed parameters."""
        return information(self.prior, self.noise_aware.estimate)

    def place(self, estimate: Gaussian) -> np.ndarray:
        """Return the mean (n,) of an estimate in prior standard deviations from the prior mean."""
        return (estimate.mean - self.prior.mean) / self.prior.sd

    def long_steps(self, estimate: Gaussian) -> dict[str, float]:
        """Return the steps of an estimate that are too long for one straight step [prior standard deviations]."""
        return long_steps(self.prior.names, self.place(estimate))

    def true_place(self) -> np.ndarray:
        """Return the truth (n,) in prior standard deviations from the prior mean, NaN without a truth."""
        true = [np.log(self.truth[name]) if name in self.truth else np.nan for name in self.prior.names]
        return (np.array(true) - self.prior.mean) / self.prior.sd

    def covered(self, estimate: Gaussian) -> dict[str, bool]:
        """Return for each parameter with a truth if its 95 % interval contains the truth."""
        errors = np.abs(self.place(estimate) - self.true_place()) * self.prior.sd / estimate.sd
        return {
            name: bool(z <= INTERVAL_REACH)
            for name, z in zip(self.prior.names, errors, strict=True)
            if np.isfinite(z)
        }

    def weakest(self) -> str:
        """Return the least informed direction, such as "sigma_0 up with R_p up"."""
        direction = self.information.weakest
        large = np.flatnonzero(np.abs(direction) >= NAMED_SHARE * np.abs(direction).max())
        named = sorted(large, key=lambda place: -abs(direction[place]))[:MOST_NAMED]
        return " with ".join(f"{self.prior.names[i]} {'up' if direction[i] > 0 else 'down'}" for i in named)


def cards(
    keys: Iterable[tuple[str, str]],
    noise_free: Iterable[Posterior],
    noise_aware: Iterable[Posterior],
    truths: Mapping[str, Mapping[str, float]],
) -> Sequence[Card]:
    """Return one card per case and setting in the order of the keys (case, setting)."""
    return [
        Card(case, setting, free, aware, comparable_truth(truths.get(case, {})))
        for (case, setting), free, aware in zip(keys, noise_free, noise_aware, strict=True)
    ]


POSTERIORS: dict[str, Callable[[Card], Gaussian]] = {
    "noise-free": lambda card: card.noise_free.estimate,
    "noise-aware": lambda card: card.noise_aware.estimate,
}
"""Posteriors by their names in the tables."""

POOLED = "all"


def cards_table(cards: Sequence[Card]) -> pd.DataFrame:
    """Return one row per case, setting and parameter; places are in prior standard deviations from the prior mean.

    "variance reduction" is the share of the prior variance that the data remove, which "least informed" states of the
    direction where it is least; "covered" says if the 95 % interval contains the truth, blank without a truth.
    """
    return pd.DataFrame([row for card in cards for row in _card_rows(card)])


def coverage_table(cards: Sequence[Card]) -> pd.DataFrame:
    """Return the share of truths in their 95 % intervals per setting, posterior and parameter, and for all.

    Each heart is one trial of the exact interval, with its share of covered parameters, because the errors of the
    parameters of one heart are not independent.
    """
    rows = [
        {"setting": setting, "posterior": posterior} | row
        for setting in dict.fromkeys(card.setting for card in cards)
        for posterior, estimate in POSTERIORS.items()
        for row in _coverage_rows([card.covered(estimate(card)) for card in cards if card.setting == setting])
    ]
    return pd.DataFrame(rows)


def _card_rows(card: Card) -> list[dict[str, object]]:
    information = card.information
    noise_free, noise_aware = card.noise_free.estimate, card.noise_aware.estimate
    covered = {name: card.covered(estimate(card)) for name, estimate in POSTERIORS.items()}
    long = {"noise-free": card.long_steps(noise_free), "noise-aware": card.long_steps(noise_aware)}
    common = {
        "rank": f"{information.rank} of {len(information.names)}",
        "effective number": information.degrees,
        "least informed": f"{card.weakest()} ({100 * information.reduction[-1]:.0f} %)",
    }
    return [
        {
            "setting": card.setting,
            "case": card.case,
            "parameter": name,
            "prior sd (%)": 100 * card.prior.sd[i],
            "noise-free": card.place(noise_free)[i],
            "noise-free sd over prior": noise_free.sd[i] / card.prior.sd[i],
            "noise-aware": card.place(noise_aware)[i],
            "noise-aware sd over prior": information.sd_ratio[i],
            "variance reduction": 1.0 - information.sd_ratio[i] ** 2,
            LONG_STEPS: ", ".join(label for label, steps in long.items() if name in steps),
            "truth": card.true_place()[i],
            "noise-free covered": _yes_or_no(covered["noise-free"].get(name)),
            "noise-aware covered": _yes_or_no(covered["noise-aware"].get(name)),
        }
        | common
        for i, name in enumerate(card.prior.names)
    ]


def _yes_or_no(covered: bool | None) -> str:
    return "" if covered is None else "yes" if covered else "no"


def _coverage_rows(coverages: Sequence[dict[str, bool]]) -> list[dict[str, object]]:
    names = dict.fromkeys(name for coverage in coverages for name in coverage)
    by_name = {name: [float(coverage[name]) for coverage in coverages if name in coverage] for name in names}
    pooled = {POOLED: [float(np.mean(list(coverage.values()))) for coverage in coverages if coverage]}
    return [_coverage_row(name, values) for name, values in (by_name | pooled).items() if values]


def _coverage_row(name: str, values: Sequence[float]) -> dict[str, object]:
    share = Share.from_count(sum(values), len(values))
    return {
        "parameter": name,
        "hearts": share.sequences,
        "covered (%)": 100 * share.covered,
        "from (%)": 100 * share.low,
        "to (%)": 100 * share.high,
    }
