r"""The search for the place at which something unknown acts.

Every place of :mod:`heartfit.places` is a hypothesis: its function, of coefficients z, added to the free parameters.
All are linearised about the fit without a place, laws also about the centre of the priors; those of the largest
predicted evidence are fitted, each also from the parameters of the best one. The evidence is averaged over the priors
of the function, N(0, D^2), the model linear about the fit:

.. math:: \ln Z = \ln \frac1n \sum_D Z(x / D, J D) - \max\{0, \ell_D - 1\} ,

less what the linear model promises of ln likelihood beyond the fit, in excess of 1: a fit that has not converged, or a
place that was not fitted, would invent evidence. The evidence of a region is that of its best place.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import logsumexp

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.evidence import Explanation, Fit, posterior
from heartfit.discovery.inference.hypothesis import Coordinate, CountedHypothesis, Hypothesis
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel, model_hypothesis
from heartfit.places import PLACES, Place, Region
from heartfit.roles import Mechanism

FEWEST_FITTED, MOST_FITTED = 3, 7
"""Numbers of places that are fitted in every search, and at most, where the linear model predicts a gain."""
PREDICTED_GAIN = 1.0
"""ln evidence over that without a place above which further places are fitted."""
PROMISE = 1.0
"""Largest ln likelihood beyond a fit that counts."""
SWITCHED_ON = (1.0, 2.5)
"""Coefficients of a law, the more promising of which it is fitted from once more, at the centre of the priors."""
FIT_LIMIT = 1200
"""Simulations after which a fit of a place is given up."""


@dataclass(frozen=True, eq=False)
class FittedPlace:
    """A place, its fit or linear model, and its ln evidence over that without a place.

    predicted: the same with all that the linear model promises beyond the fit.
    """

    kind: type[Place]
    explanation: Explanation
    ln_bayes_factor: float
    fitted: bool = True
    predicted: float = -np.inf

    @property
    def region(self) -> Region:
        return self.kind.region

    def beside(self, gain: float) -> "FittedPlace":
        """Return the place compared with a fit without one whose ln evidence is higher by the ``gain``."""
        factor, predicted = self.ln_bayes_factor - gain, self.predicted - gain
        return replace(self, ln_bayes_factor=factor, predicted=predicted)


@dataclass(frozen=True, eq=False)
class RankedPlaces:
    """The fit without a place, and all places in descending evidence."""

    baseline: Explanation
    places: tuple[FittedPlace, ...]

    def by_region(self) -> dict[Region, FittedPlace]:
        """Return the best place of each region, the best region first."""
        regions: dict[Region, FittedPlace] = {}
        for place in self.places:
            regions.setdefault(place.region, place)
        return regions


def place_hypothesis(model: SphereForwardModel, kind: type[Place]) -> Hypothesis:
    """Return the hypothesis of a place about a forward model."""
    period, base = model.nominal.heart.period, len(model.base)
    own = tuple(Coordinate(f"{kind.__name__}.{index}", kind.one_sided) for index in range(kind.size))

    def split(x: Floats) -> tuple[Floats, Sequence[Mechanism]]:
        return x[:base], (kind.from_standardised(x[base:], period),)

    return model_hypothesis(model, (kind.__name__,), own, split)


@dataclass(frozen=True, eq=False)
class PlaceSearch:
    """The places about a fit without one."""

    context: FitContext
    model: SphereForwardModel
    baseline: Explanation

    def run(self, kinds: Sequence[type[Place]] = PLACES) -> RankedPlaces:
        """Return the fits of all places; one whose simulations fail is left out."""
        screened = [place for place in map(self._screened, kinds) if place is not None]
        screened.sort(key=lambda place: place.predicted, reverse=True)
        promising = [
            place
            for rank, place in enumerate(screened[:MOST_FITTED])
            if rank < FEWEST_FITTED or place.predicted > PREDICTED_GAIN
        ]
        fitted = [self._fitted(place) for place in promising]
        best = _ranked(fitted)[0]
        again = [place if place.region == best.region else self._from_best(place, best) for place in fitted]
        return self._beside_base([*again, *(place for place in screened if place not in promising)])

    def _beside_base(self, places: Sequence[FittedPlace]) -> RankedPlaces:
        """Return the places compared with the better of a fit without a place and one from the best place's."""
        best = _ranked(places)[0].explanation.fit
        baseline = self.context.improve(self.baseline, best.x[: self.base], best.jacobian[:, : self.base])
        gain = baseline.log_evidence - self.baseline.log_evidence
        return RankedPlaces(baseline, _ranked(place.beside(gain) for place in places))

    @property
    def base(self) -> int:
        """Number of free parameters, whose coordinates come first."""
        return len(self.model.base)

    @property
    def period(self) -> float:
        """Period of the beat [s]."""
        return self.model.nominal.heart.period

    def fitted_from(self, kind: type[Place], x: Floats) -> FittedPlace | None:
        """Return a place fitted from the coordinates x; None where its simulations fail."""
        explained = self.context.explain(place_hypothesis(self.model, kind), x, limit=FIT_LIMIT)
        return None if explained is None else self._judged(kind, explained)

    def fitted_beside(self, kind: type[Place], other: FittedPlace) -> FittedPlace:
        """Return a place fitted from the parameters of another one; its linear model where its simulations fail."""
        screened = self._screened(kind)
        if screened is None:
            raise ValueError(f"{kind.__name__} acts on no recorded curve")
        return self._from_best(self._fitted(screened), other)

    def _screened(self, kind: type[Place]) -> FittedPlace | None:
        """Return the linear model of a place about the fit without one."""
        hypothesis = place_hypothesis(self.model, kind)
        x = np.concatenate([self.baseline.fit.x, np.zeros(kind.size)])
        counted = CountedHypothesis(hypothesis)
        columns = counted.jacobian(x, self.baseline.fit.predicted, self.base)
        self.context.simulations += counted.runs
        if not columns.any():
            return None
        jacobian = np.column_stack([self.baseline.fit.jacobian, columns])
        unfitted = Fit(hypothesis, x, self.baseline.fit.predicted, jacobian, np.inf, converged=False)
        place = self._judged(kind, self._explained(unfitted), fitted=False)
        switched_on = self._switched_on(kind)
        if switched_on is None:
            return place
        return replace(place, predicted=max(place.predicted, self._judged(kind, switched_on).predicted))

    def _switched_on(self, kind: type[Place]) -> Explanation | None:
        """Return the linear model of a law that is switched on at the centre of the priors; None for a free function.

        The fit without a strong leak or stenosis has parameters far from those with it, and its linear model predicts
        nothing.
        """
        sizes = SWITCHED_ON if kind.one_sided else ()
        models = [model for size in sizes if (model := self._at_centre(kind, size)) is not None]
        return max(models, key=lambda model: self._judged(kind, model).predicted, default=None)

    def _at_centre(self, kind: type[Place], size: float) -> Explanation | None:
        """Return the linear model of a law of a size at the centre of the priors; None where it does not beat.

        The slopes by the parameters are those without the place.
        """
        centre = self._centre
        if centre is None:
            return None
        counted = CountedHypothesis(place_hypothesis(self.model, kind))
        x = np.concatenate([centre.fit.x, np.full(kind.size, size)])
        predicted = counted(x)
        if predicted is None:
            return None
        jacobian = np.column_stack([centre.fit.jacobian, counted.jacobian(x, predicted, self.base)])
        self.context.simulations += counted.runs
        return self._explained(Fit(counted.hypothesis, x, predicted, jacobian, np.inf, converged=False))

    @cached_property
    def _centre(self) -> Explanation | None:
        """The heart without a place at the centre of the priors; None where it does not beat."""
        hypothesis = self.baseline.fit.hypothesis
        return self.context.linearise(hypothesis, hypothesis.at(0.0))

    def _fitted(self, place: FittedPlace) -> FittedPlace:
        explained = self._fit(place, place.explanation.fit.x, place.explanation.fit.jacobian)
        switched_on = self._switched_on(place.kind)
        if switched_on is not None:
            explained = _better(explained, self._fit(place, switched_on.fit.x, switched_on.fit.jacobian))
        return place if explained is None else self._judged(place.kind, explained)

    def _from_best(self, place: FittedPlace, best: FittedPlace) -> FittedPlace:
        """Return the better of a place's fit and one that starts from the parameters of the best place."""
        shared = best.explanation.fit.x[: self.base]
        start = np.concatenate([shared, place.explanation.fit.x[self.base :]])
        other = self._fit(place, start, place.explanation.fit.jacobian)
        again = place.explanation if place.fitted else None
        explained = _better(again, other)
        return place if explained is None else self._judged(place.kind, explained)

    def _fit(self, place: FittedPlace, start: Floats, slopes: Floats) -> Explanation | None:
        hypothesis = place.explanation.fit.hypothesis
        return self.context.explain(hypothesis, start, slopes, limit=FIT_LIMIT)

    def _explained(self, fit: Fit) -> Explanation:
        return Explanation.from_fit(fit, self.context.data.values, self.context.whitening)

    def _judged(self, kind: type[Place], explained: Explanation, fitted: bool = True) -> FittedPlace:
        evidences, promised = np.array(list(self._evidences(explained.fit, kind.deviations(self.period)))).T
        guarded = evidences - np.maximum(0.0, promised - PROMISE)
        factor, predicted = (
            float(logsumexp(some) - np.log(some.size)) - self.baseline.log_evidence
            for some in (guarded, evidences)
        )
        return FittedPlace(kind, explained, factor, fitted, predicted)

    def _evidences(self, fit: Fit, deviations: Floats) -> Iterable[tuple[float, float]]:
        """Yield ln evidence and the promised ln likelihood under every prior of the function.

        The linear model stands at the function zero, where its coefficients are the same under all priors.
        """
        left, whitening = self.context.data.values - fit.predicted, self.context.whitening
        now = whitening.log_likelihood(left)
        x = np.concatenate([fit.x[: self.base], np.zeros(fit.x.size - self.base)])
        residual = left + fit.jacobian @ (fit.x - x)
        for row in deviations:
            jacobian = fit.jacobian * np.concatenate([np.ones(self.base), row])
            linear = posterior(whitening, x, residual, jacobian, fit.hypothesis.one_sided)
            bounded = np.maximum(linear.mean, fit.hypothesis.lower)
            beyond = whitening.log_likelihood(residual - jacobian @ (bounded - x)) - now
            yield linear.log_evidence, beyond


def _better(one: Explanation | None, other: Explanation | None) -> Explanation | None:
    fits = [explained for explained in (one, other) if explained is not None]
    return min(fits, key=lambda explained: explained.fit.objective, default=None)


def _ranked(places: Iterable[FittedPlace]) -> tuple[FittedPlace, ...]:
    return tuple(sorted(places, key=lambda place: place.ln_bayes_factor, reverse=True))
