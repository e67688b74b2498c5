"""Diagnoses of synthetic cases compared with their answers, and the rates counted over many cases."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import binomtest

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.discovery.sphere_model.limits import detection_limits
from heartfit.observation.noise_model import Share
from heartfit.synthetic.campaign import Effect, Population
from heartfit.synthetic.case import Answer
from heartfit.synthetic.trial import REFUSED, ScoredDiagnosis

SILENT = ("none", "model", "insufficient", REFUSED)
"""Verdicts that claim nothing."""


@dataclass(frozen=True)
class Scored:
    """Diagnosis of a planted case and the answer."""

    answer: Answer
    finding: ScoredDiagnosis

    @property
    def truth(self) -> frozenset[str]:
        return frozenset(effect.name for effect in self.answer.effects)

    @property
    def planted(self) -> str:
        """Names of the planted effects as text."""
        return " + ".join(effect.name for effect in self.answer.effects) or "nothing"

    @property
    def scales(self) -> float:
        """Size of the planted effects [scales]; 0 without an effect."""
        return max((effect.scales for effect in self.answer.effects), default=0.0)

    @property
    def detected(self) -> bool:
        """True if the verdict claims that the model lacks something."""
        return self.finding.verdict not in SILENT

    @property
    def named(self) -> bool:
        """True if the verdict names one or two mechanisms."""
        return self.finding.verdict in ("named", "two")

    @property
    def right(self) -> bool:
        """True if the verdict names exactly the planted effects."""
        return self.named and self.finding.names == self.truth

    @property
    def in_group(self) -> bool:
        """True if the verdict is a group that contains the planted effects."""
        return self.finding.verdict == "group" and self.truth <= self.finding.names

    @property
    def conclusion(self) -> str:
        """Name of the mechanism if one is named, otherwise the verdict."""
        (*_, name) = [self.finding.verdict, *sorted(self.finding.names)]
        return name if self.finding.verdict == "named" else self.finding.verdict

    def with_data(self, data: str) -> "Scored":
        """Return the case with the diagnosis of another data set; raise KeyError if that was not searched."""
        return replace(self, finding=self.finding.other[data])

    def ratio(self, effect: Effect) -> float:
        """Return the estimated over the planted amplitude, both relative to the off value."""
        return (self._cause_of(effect).amplitude - effect.off) / (effect.amplitude - effect.off)

    def covered(self, effect: Effect) -> bool:
        """Return whether the interval of the amplitude contains the planted amplitude."""
        low, high = self._cause_of(effect).interval
        return low <= effect.amplitude <= high

    def _cause_of(self, effect: Effect) -> Cause:
        return next(cause for cause in self.finding.mechanisms if cause.name == effect.name)


def of_population(scored: Iterable[Scored], population: Population) -> list[Scored]:
    """Return the cases of a population."""
    return [case for case in scored if case.answer.population == population]


Holds = Callable[[Scored], bool]
"""Property of a scored case."""


@dataclass(frozen=True)
class Rate:
    """Share of the cases ``among`` for which ``holds`` is true, with an optional target (lower or upper bound).

    Only cases of the ``population`` are counted.
    """

    name: str
    among: Holds
    holds: Holds
    target: float | None = None
    at_most: bool = False
    population: Population = "as searched"

    def share_of(self, scored: Iterable[Scored]) -> Share | None:
        """Return the share with its exact 95 % interval, None if there is no such case."""
        cases = of_population(scored, self.population)
        outcomes = [self.holds(case) for case in cases if self.among(case)]
        return Share.from_count(float(sum(outcomes)), len(outcomes)) if outcomes else None

    def meets_target(self, share: Share) -> bool | None:
        """Return whether the share itself meets the target, None without a target."""
        if self.target is None:
            return None
        return share.covered <= self.target if self.at_most else share.covered >= self.target


def _null(case: Scored) -> bool:
    return case.answer.kind == "none"


def _single(case: Scored) -> bool:
    return case.answer.kind == "single"


def _out_of_library(case: Scored) -> bool:
    return case.answer.kind == "outside"


def _pair(case: Scored) -> bool:
    return case.answer.kind == "two"


RATES = (
    Rate("false alarms of nulls", _null, lambda case: case.detected, 0.04, at_most=True),
    Rate("nulls that were given a name", _null, lambda case: case.named),
    Rate(
        "singles detected at 2 scales", lambda case: _single(case) and case.scales == 2.0,
        lambda case: case.detected, 0.75,
    ),
    Rate("singles detected at more", lambda case: _single(case) and case.scales > 2.0, lambda case: case.detected),
    Rate("singles named right, of the named", lambda case: _single(case) and case.named, lambda case: case.right, 0.95),
    Rate("named right, of all that were named", lambda case: case.named, lambda case: case.right),
    Rate(
        "singles in their group, of the groups", lambda case: _single(case) and case.finding.verdict == "group",
        lambda case: case.in_group,
    ),
    Rate("outsiders detected", _out_of_library, lambda case: case.detected),
    Rate(
        "outsiders called unknown, of the detected", lambda case: _out_of_library(case) and case.detected,
        lambda case: case.finding.verdict == "unknown", 0.85,
    ),
    Rate("pairs with both right", _pair, lambda case: case.right),
    Rate(
        "pairs with a wrong pair", _pair, lambda case: case.finding.verdict == "two" and not case.right, 0.02,
        at_most=True,
    ),
    Rate("pairs with one name, and right", _pair, lambda case: case.named and case.finding.names < case.truth),
)  # fmt: skip


def _strong(case: Scored) -> bool:
    return _single(case) and case.scales >= 2.0


COMPARED_RATES = (
    Rate("false alarms of nulls", _null, lambda case: case.detected, 0.05, at_most=True),
    Rate("singles from 2 scales on, detected", _strong, lambda case: case.detected),
    Rate(
        "singles from 2 scales on, named right, of the named", lambda case: _strong(case) and case.named,
        lambda case: case.right, 0.90,
    ),
    Rate(
        "amplitude in its interval, of those named right", lambda case: _strong(case) and case.right,
        lambda case: case.covered(case.answer.effects[0]),
    ),
)  # fmt: skip
"""Rates that are compared between the populations; their targets are those of the misspecified one."""
MISSPECIFIED_RATES = tuple(
    replace(rate, name=f"misspecified: {rate.name}", population="misspecified") for rate in COMPARED_RATES
)


def binomial_p_value(share: Share, claim: float, at_most: bool) -> float:
    r"""One-sided binomial p value: probability of a count at least as bad as the observed one at the rate ``claim``.

    .. math:: P(X \ge k) \text{ for a rate of at most } p, \qquad P(X \le k) \text{ for one of at least } p, \qquad
              X \sim \mathrm{Bin}(n, p)
    """
    count = round(share.covered * share.sequences)
    worse = "greater" if at_most else "less"
    return float(binomtest(count, share.sequences, claim, worse).pvalue)


@dataclass(frozen=True)
class DetectableSizes:
    """Smallest detectable sizes [scales] by name and sign; infinite if no size tried is detected."""

    scales: Mapping[tuple[str, float], float]

    @classmethod
    def of(cls, scored: Iterable[Scored], threshold: float) -> "DetectableSizes":
        """Compute the sizes for all planted single effects, on the sphere of an average adult."""
        names = {case.answer.effects[0].name for case in scored if case.answer.kind == "single"}
        computed = detection_limits(1, names=sorted(names), threshold=threshold) if names else ()
        return cls(
            {(limit.name, limit.sign): np.inf if limit.least is None else limit.least for limit in computed}
        )

    def describe(self, name: str) -> str:
        """Return the detectable sizes of an effect as text, one per sign; empty for an effect outside the library."""
        sizes = [size for (effect, _), size in self.scales.items() if effect == name]
        return " or ".join(f"{size:.1f}" if np.isfinite(size) else "not to 4" for size in sizes)

    def of_effect(self, effect: Effect) -> float:
        """Return the detectable size of an effect, of its sign [scales]."""
        return self.scales[effect.name, float(np.sign(effect.amplitude - effect.off))]

    def is_detectable(self, case: Scored) -> bool:
        """Return whether a case hides a single effect of the library of at least the detectable size."""
        if case.answer.kind != "single":
            return False
        (effect,) = case.answer.effects
        return effect.scales >= self.of_effect(effect)

    def rates(self, target: float | None = None) -> tuple[Rate, ...]:
        """Return all rates and those of the detectable effects; target: share of these that is named right."""
        return (
            *RATES,
            Rate("singles above their limit, detected", self.is_detectable, lambda case: case.detected),
            Rate(
                "singles above their limit, named right", self.is_detectable, lambda case: case.right, target
            ),
        )
