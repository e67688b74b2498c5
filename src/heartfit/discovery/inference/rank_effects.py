r"""Ranking of the effects that any forward model lacks: the search of this folder for a function of named parameters.

The forward model predicts one series of data from parameters by name. Those of the base model have normal priors; each
effect is switched on by one more parameter, whose typical size, the scale, is the standard deviation of its prior:

.. math:: \theta_i = m_i + s_i x_i, \qquad a_j = \sigma_j x_j, \qquad x \sim N(0, 1), \quad x_j \ge 0
          \text{ of an effect of known sign.}

Each effect is fitted again with a scale four times as large and four times as small, and a ranking that would then have
another leader, be it "unknown", or detect an effect or none, says so.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from math import inf

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.decide import DEFAULT_RULES, Effects, Rules, Verdict
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.inference.scale_dependence import scale_dependences
from heartfit.discovery.inference.search import Findings, search

UNKNOWN_SIZE, UNKNOWN_LENGTH = 3.0, 0.1
"""Default size of an unknown effect over the noise, and its correlation length over the span of the times."""

Model = Callable[..., Floats | None]
"""Map from parameters by name to the predicted series (n,); None where the simulation fails."""


@dataclass(frozen=True, repr=False)
class RankedEffects:
    """Verdict and ranking of effects.

    verdict: "none", "named", "two", "group" or "unknown"; named: the effects that it names; ranking: ln Bayes factors
    over the base model, in descending order, that of a smooth effect of any shape as "unknown"; sizes: median, least
    and largest value (95 %) of every effect alone, in the unit of its scale; notes: how the ranking depends on the
    scales, empty where it does not; findings: all fits.
    """

    verdict: Verdict
    named: Effects
    ranking: Mapping[str, float]
    sizes: Mapping[str, tuple[float, float, float]]
    notes: tuple[str, ...]
    findings: Findings = field(compare=False)

    def __repr__(self) -> str:
        factors = ", ".join(f"{name} {factor:.1f}" for name, factor in self.ranking.items())
        return f"RankedEffects({' '.join([self.verdict, *self.named])}; ln Bayes factors: {factors})"


@dataclass(frozen=True)
class _Question:
    """Base parameters (mean, sd) and scales of effects by name, and the effects of unknown sign."""

    model: Model
    base: Mapping[str, tuple[float, float]]
    scales: Mapping[str, float]
    signed: Collection[str]
    size: int

    def hypothesis(self, effects: Effects, factor: float = 1.0) -> Hypothesis:
        """The model with these effects, their scales times a factor."""
        coordinates = (
            *map(Coordinate, self.base),
            *(Coordinate(name, one_sided=name not in self.signed, amplitude=True) for name in effects),
        )

        def forward(x: Floats) -> Floats | None:
            values = {
                name: mean + sd * z for (name, (mean, sd)), z in zip(self.base.items(), x, strict=False)
            }
            switched = zip(effects, x[len(self.base) :], strict=True)
            return self._predict(values | {name: factor * self.scales[name] * z for name, z in switched})

        return Hypothesis(effects, coordinates, forward)

    def _predict(self, values: Mapping[str, float]) -> Floats | None:
        predicted = self.model(**{name: float(value) for name, value in values.items()})
        if predicted is None:
            return None
        series = np.asarray(predicted, dtype=float)
        if series.shape != (self.size,):
            raise InputError(
                f"rank_effects: the model returns the shape {series.shape}; expected ({self.size},), one value for "
                "each time: correct it"
            )
        return series if np.isfinite(series).all() else None


def rank_effects(
    model: Model,
    times: Floats | Sequence[float],
    values: Floats | Sequence[float],
    base: Mapping[str, tuple[float, float]],
    effects: Mapping[str, float],
    sd: float | Sequence[float],
    *,
    signed: Collection[str] = (),
    unknown: float | None = None,
    length: float | None = None,
    period: float = inf,
    rules: Rules = DEFAULT_RULES,
) -> RankedEffects:
    """Rank the effects that explain what the base model leaves of a series of data.

    model: called with all base parameters and some effects by name; an effect that is not passed, or is 0, must be
    absent. times, values (n,): of the data. base: mean and standard deviation of the normal prior by parameter.
    effects: scale of the prior by effect, positive; half-normal, or normal for the ``signed`` ones. sd: standard
    deviation of independent noise, or several that are equally likely. unknown, length: standard deviation of an effect
    that is none of these, three times the noise if None, and its correlation length, a tenth of the span of the times
    if None. period: of periodic data, in the unit of the times.

    The thresholds of the ``rules`` were chosen on simulated hearts. Raises InputError for a scale that is not positive,
    for a name that is both parameter and effect, for a prediction of another shape, and for a model that fails at the
    means of the priors.
    """
    _require_names(base, effects, signed)
    data = _data(times, values, sd, unknown, length, period)
    question = _Question(model, base, effects, signed, data.values.size)
    singles = [question.hypothesis((name,)) for name in effects]
    findings = search(data, question.hypothesis(()), singles, question.hypothesis, rules)
    decision = findings.decision
    return RankedEffects(
        decision.verdict,
        decision.effects,
        _ranking(findings),
        _sizes(findings, effects),
        tuple(_scale_notes(question, data, findings)),
        findings,
    )


def _data(
    times: Floats | Sequence[float],
    values: Floats | Sequence[float],
    sd: float | Sequence[float],
    unknown: float | None,
    length: float | None,
    period: float,
) -> Data:
    """Return the series as data, with independent noise and the default size and length of an unknown effect."""
    middle, span = float(np.median(sd)), float(np.ptp(times))
    noise = Noise.white(
        sd,
        UNKNOWN_SIZE * middle if unknown is None else unknown,
        UNKNOWN_LENGTH * span if length is None else length,
    )
    return Data(np.asarray(values), (Block("series", "1", np.asarray(times), period, noise),))


def _require_names(
    base: Mapping[str, tuple[float, float]], effects: Mapping[str, float], signed: Collection[str]
) -> None:
    if wrong := {name: scale for name, scale in effects.items() if not 0.0 < scale < inf}:
        raise InputError(
            f"rank_effects: scales {wrong}; expected positive numbers: the typical sizes of the effects"
        )
    if twice := sorted(base.keys() & effects.keys()):
        raise InputError(
            f"rank_effects: {', '.join(twice)} in base and effects; expected it in one: leave one out"
        )
    if strange := sorted(set(signed) - effects.keys()):
        raise InputError(
            f"rank_effects: signed names {', '.join(strange)}; expected some of {', '.join(effects)}: correct it"
        )


def _ranking(findings: Findings) -> dict[str, float]:
    evidences = findings.evidences
    factors = {effects[0]: value - evidences.baseline for effects, value in evidences.singles.items()}
    factors["unknown"] = evidences.discrepancy - evidences.baseline
    return dict(sorted(factors.items(), key=lambda item: -item[1]))


def _sizes(findings: Findings, scales: Mapping[str, float]) -> dict[str, tuple[float, float, float]]:
    """Sizes of the named effects in their joint fit, and of the others alone."""
    sizes, named = {}, findings.decision.effects
    for single in findings.survey.singles:
        (name,) = single.effects
        fitted = findings.explanation(named) if name in named else single
        middle, low, high = (scales[name] * value for value in fitted.interval(name))
        sizes[name] = (middle, low, high)
    return sizes


def _scale_notes(question: _Question, data: Data, findings: Findings) -> Iterator[str]:
    """Yield a sentence for each effect whose scale decides which effect leads, or whether one is detected."""
    least, context = findings.rules.detected, FitContext(data)
    at_scale = {
        single.effects[0]: partial(_factor_at, question, context, findings, single.effects[0])
        for single in findings.survey.singles
    }
    for case in scale_dependences(_ranking(findings), at_scale, least):
        yield (
            f"the ranking depends on the scale of {case.name}, {question.scales[case.name]:.3g}: {case} "
            f"(ln Bayes factors, detected from {least:g})"
        )


def _factor_at(
    question: _Question, context: FitContext, findings: Findings, name: str, factor: float
) -> float:
    """ln Bayes factor of an effect with its scale times a factor, fitted from its fit and from the prior mean."""
    hypothesis = question.hypothesis((name,), factor)
    start = findings.explanation((name,)).fit.x.copy()
    start[-1] /= factor
    starts = (start, hypothesis.at(findings.rules.start_amplitude))
    fits = [context.explain(hypothesis, at) for at in starts]
    completed = [fit.log_evidence for fit in fits if fit is not None]
    return max(completed, default=-inf) - findings.evidences.baseline
