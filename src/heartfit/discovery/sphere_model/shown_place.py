"""The function of time at a place, as a card shows it: its clear phases, and the laws that it may follow."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import (
    CLEAR_DEVIATIONS,
    ActingPlace,
    ClearSpan,
    PlaceFunction,
    RankedLaw,
)
from heartfit.discovery.sphere_model.law_ranking import FittedLaw, FunctionPosterior
from heartfit.discovery.sphere_model.place_search import FittedPlace, PlaceSearch
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.places.laws import TIME_FORMS, LawState, laws_of
from heartfit.places.periodic import PeriodicFunction
from heartfit.places.place import FunctionOfTime

SAMPLES = 200
"""Equidistant times of a function."""


@dataclass(frozen=True, eq=False)
class ShownPlace:
    """A place with the function of time of its region: times of the function and after the trigger (k,) [s]."""

    place: FittedPlace
    kind: type[FunctionOfTime]
    times: Floats
    after_trigger: Floats
    mean: Floats
    sd: Floats
    laws: tuple[FittedLaw, ...]

    @classmethod
    def from_search(cls, search: PlaceSearch, place: FittedPlace) -> "ShownPlace":
        """Fit the function of time of the place's region, and rank the laws that it may follow."""
        kind = TIME_FORMS[place.region]
        fitted = place if place.kind is kind else _function_of_time(search, place, kind)
        posterior, period = fitted.explanation.posterior, search.period
        heart, state = _simulated(search, fitted, kind)
        function = FunctionPosterior(
            kind, posterior.mean[search.base :], posterior.covariance[search.base :, search.base :], period
        )
        return cls(
            place,
            kind,
            state.times,
            np.mod(state.times + zero_of(kind, heart) - heart.trigger, period),
            *function.values(state.times),
            function.rank(laws_of(place.region, state)),
        )

    def acting(self) -> ActingPlace:
        """Return the region, the size of the function and its laws."""
        best = self.laws[0].ln_likelihood
        laws = tuple(
            RankedLaw(
                one.law.name,
                one.law.formula,
                one.size,
                one.law.unit,
                one.ln_likelihood - best,
                dict(one.law.shapes[one.shape]),
            )
            for one in self.laws
        )
        kind = self.place.kind
        return ActingPlace(
            kind.region, kind.__name__, kind.slot, self.place.ln_bayes_factor, self._spans(), laws
        )

    def function(self) -> PlaceFunction:
        """Return the curves of the function and of its best law, in the order of the time after the trigger."""
        order = np.argsort(self.after_trigger)
        curves = (values[order] for values in (self.after_trigger, self.mean, self.sd, self.laws[0].values))
        return PlaceFunction(self.kind.region, self.kind.unit, *curves)

    def _spans(self) -> tuple[ClearSpan, ...]:
        """Return the spans in which the function is clear, the clearest first."""
        order = np.argsort(self.after_trigger)
        times, mean, sd = (values[order] for values in (self.after_trigger, self.mean, self.sd))
        clear = np.abs(mean) > CLEAR_DEVIATIONS * sd
        edges = np.flatnonzero(np.diff(clear.astype(int), prepend=0, append=0))
        spans = [
            (first, last, first + int(np.argmax(np.abs(mean[first:last] / sd[first:last]))))
            for first, last in edges.reshape(-1, 2)
        ]
        spans.sort(key=lambda span: -abs(mean[span[2]] / sd[span[2]]))
        return tuple(
            ClearSpan(
                float(times[first]),
                float(times[last - 1]),
                float(mean[peak]),
                float(sd[peak]),
                self.kind.unit,
            )
            for first, last, peak in spans
        )


def _function_of_time(search: PlaceSearch, place: FittedPlace, kind: type[FunctionOfTime]) -> FittedPlace:
    """Return the function of time fitted with a place, from what the laws of the place make where it has some."""
    z, fitted = _coefficients(search, place, kind), None
    if z is not None:
        fitted = search.fitted_from(kind, np.concatenate([place.explanation.fit.x[: search.base], z]))
    return fitted or search.fitted_beside(kind, place)


def _coefficients(search: PlaceSearch, place: FittedPlace, kind: type[FunctionOfTime]) -> Floats | None:
    """Return the coefficients of the function that the laws of a place make in its beat; None without laws."""
    sizes = place.kind.from_standardised(place.explanation.fit.x[search.base :], search.period).sizes()
    if not sizes:
        return None
    _, state = _simulated(search, place, kind)
    curves = {law.name: law.curves[0] for law in laws_of(place.region, state)}
    values = np.sum([size * curves[name] for name, size in sizes.items()], axis=0)
    return kind(PeriodicFunction.from_samples(values, search.period)).standardised()


def _simulated(search: PlaceSearch, place: FittedPlace, kind: type[FunctionOfTime]) -> tuple[Heart, LawState]:
    """Return the heart with a fitted place, and the state of its beat at the times of a function of ``kind``."""
    x, period = place.explanation.fit.x, search.period
    simulated = search.model.simulate(
        x[: search.base], (place.kind.from_standardised(x[search.base :], period),)
    )
    if simulated is None:
        raise ValueError(f"{place.kind.__name__}: the fitted beat fails")
    heart, beat = simulated
    return heart, law_state(beat, period * np.arange(SAMPLES) / SAMPLES, zero_of(kind, heart))


def zero_of(kind: type[FunctionOfTime], heart: Heart) -> float:
    """Return the simulated time [s] at which the time of a function is zero."""
    return {"beat": 0.0, "activation": heart.tissue.control.onset, "trigger": heart.trigger}[kind.zero]


def law_state(beat: Beat, times: Floats, zero: float) -> LawState:
    """Return the signals of a beat at ``times`` (k,) [s] of a function that is zero at the simulated time ``zero``."""
    signals = {
        name: np.interp(times + zero, beat.time, values, period=beat.period)
        for name, values in beat.signals().items()
    }
    return LawState(times, signals, beat.period)
