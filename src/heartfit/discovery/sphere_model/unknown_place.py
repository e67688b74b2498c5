"""The verdict on where an unknown effect acts, beside the names of the library.

A name stands against every place of another region: one that explains the searched samples better, and helps on the
held-out ones, withdraws it. Without a name, the detected places that help there tell on which region something unknown
acts, and its function which law it follows.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.sphere_model.cause import (
    CLEAR_DEVIATIONS,
    ActingPlace,
    ClearSpan,
    Diagnosis,
    Gain,
    PlaceFunction,
    RankedLaw,
)
from heartfit.discovery.sphere_model.held_out import predict_extension
from heartfit.discovery.sphere_model.law_ranking import FittedLaw, FunctionPosterior
from heartfit.discovery.sphere_model.place_search import (
    BASE,
    FittedPlace,
    PlaceSearch,
    by_region,
    place_hypothesis,
)
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import VOLUME_ALONE, SearchedRecording
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.places import Place, Region, regions_of
from heartfit.places.laws import TIME_FORMS, LawState, laws_of
from heartfit.places.place import FunctionOfTime

LEAD = 3.0
"""ln Bayes factor within which another region is not told from the best."""
SAMPLES = 200
"""Equidistant times of a function."""
Conditions = Mapping[str, Recording]


def locate(
    diagnosis: Diagnosis, case: SearchedRecording, conditions: Conditions, kinds: Sequence[type[Place]]
) -> Diagnosis:
    """Return the diagnosis with the regions on which something unknown acts.

    Without ``kinds`` of places, and for a volume alone, which does not tell regions apart, it stays as it is.
    """
    if not kinds or case.recording.searched == VOLUME_ALONE:
        return diagnosis
    context = FitContext(case.data)
    search = PlaceSearch(context, case.model, case.findings.survey.baseline)
    judged = _Judge(case, conditions).judged(by_region(search.run(kinds)), _named_regions(diagnosis, case))
    least = max(case.rules.detected, _evidence_of_name(diagnosis))
    acting = [place for place in judged if place.place.ln_bayes_factor >= least]
    located = replace(diagnosis, simulations=diagnosis.simulations + context.simulations)
    return _unknown(located, search, acting) if acting else located


def _named_regions(diagnosis: Diagnosis, case: SearchedRecording) -> frozenset[Region]:
    kinds = (case.library[cause.name].kind for cause in diagnosis.mechanisms)
    return frozenset(region for kind in kinds for region in regions_of(kind))


def _evidence_of_name(diagnosis: Diagnosis) -> float:
    return max((cause.ln_bayes_factor for cause in diagnosis.mechanisms), default=-np.inf)


@dataclass(frozen=True, eq=False)
class _JudgedPlace:
    """The best place of a region, and its gains on held-out samples."""

    place: FittedPlace
    gains: tuple[Gain, ...]


@dataclass(frozen=True, eq=False)
class _Judge:
    case: SearchedRecording
    conditions: Conditions

    def judged(self, regions: Mapping[Region, FittedPlace], named: frozenset[Region]) -> list[_JudgedPlace]:
        """Return the detected places of other regions that help on held-out samples, the best first."""
        detected = [
            place
            for region, place in regions.items()
            if region not in named and place.ln_bayes_factor >= self.case.rules.detected
        ]
        judged = (self._judged(place) for place in detected)
        return [place for place in judged if place is not None]

    def _judged(self, place: FittedPlace) -> _JudgedPlace | None:
        extension = partial(place_hypothesis, kind=place.kind)
        tests = predict_extension(self.case, extension, place.explanation.fit.x, self.conditions)
        if not all(test and test.helps() for test in tests):
            return None
        return _JudgedPlace(place, tuple(gain for test in tests if test for gain in test.gains()))


def _unknown(diagnosis: Diagnosis, search: PlaceSearch, acting: Sequence[_JudgedPlace]) -> Diagnosis:
    """Return the diagnosis of an unknown effect that acts on the best region, or on one of those near it."""
    best = acting[0].place.ln_bayes_factor
    near = [place.place for place in acting if place.place.ln_bayes_factor > best - LEAD]
    shown = [ShownPlace.from_search(search, place) for place in near]
    return replace(
        diagnosis,
        verdict="unknown",
        mechanisms=(),
        alternatives=(),
        from_all_samples=(),
        withdrawn=(*diagnosis.withdrawn, *(cause.name for cause in diagnosis.mechanisms)),
        gain=acting[0].gains,
        acting=tuple(place.acting() for place in shown),
        functions=tuple(place.function() for place in shown),
    )


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
        fitted = place if place.kind is kind else search.fitted_beside(kind, place)
        fit, posterior = fitted.explanation.fit, fitted.explanation.posterior
        simulated = search.model.simulate(
            fit.x[:BASE], (kind.from_standardised(fit.x[BASE:], search.period),)
        )
        if simulated is None:
            raise ValueError(f"{kind.__name__}: the fitted beat fails")
        heart, beat = simulated
        period, zero = search.period, zero_of(kind, heart)
        times = period * np.arange(SAMPLES) / SAMPLES
        function = FunctionPosterior(kind, posterior.mean[BASE:], posterior.covariance[BASE:, BASE:], period)
        state = law_state(beat, times, zero)
        laws = function.rank(laws_of(place.region, state))
        return cls(
            place,
            kind,
            times,
            np.mod(times + zero - heart.trigger, period),
            *function.values(times),
            laws,
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
