"""The verdict on where an unknown effect acts, given the names of the library.

All samples choose the places: half of them would miss many. A name stands against every place of another region that
explains all samples better. Without a name, a detected place tells on which region something acts, and its function
which law it follows; a mechanism of the library that acts there is named where it explains all samples as well. What is
detected competes once more on the half that the library's search has seen, and its choice must predict the other half.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.decide import Effects
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.sphere_model.cause import Diagnosis, Gain, Trace
from heartfit.discovery.sphere_model.forward_model import hypothesis
from heartfit.discovery.sphere_model.held_out import Extension, predict_extension
from heartfit.discovery.sphere_model.place_search import (
    FittedPlace,
    PlaceSearch,
    RankedPlaces,
    place_hypothesis,
)
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import VOLUME_ALONE, SearchedRecording
from heartfit.discovery.sphere_model.shown_place import ShownPlace
from heartfit.places import Place, regions_of

LEAD = 3.0
"""ln Bayes factor within which another region is not told from the best."""
Conditions = Mapping[str, Recording]


def locate(
    diagnosis: Diagnosis, case: SearchedRecording, conditions: Conditions, kinds: Sequence[type[Place]]
) -> Diagnosis:
    """Return the diagnosis with the regions on which something unknown acts.

    Without ``kinds`` of places, and for a volume alone, which does not tell regions apart, it stays as it is.
    """
    baseline = case.refit(()) if kinds and case.recording.searched != VOLUME_ALONE else None
    if baseline is None:
        return diagnosis
    search = PlaceSearch(case.whole_context, case.whole.model, baseline)
    ranked = search.run(kinds)
    competition = _Competition(case, conditions, ranked)
    located = _concluded(diagnosis, search, competition, competition.detected(diagnosis))
    return replace(located, simulations=case.model.simulations + case.whole.model.simulations)


def _concluded(
    diagnosis: Diagnosis,
    search: PlaceSearch,
    competition: "_Competition",
    detected: Sequence[FittedPlace],
) -> Diagnosis:
    """Return the diagnosis with a confirmed name, or of an unknown effect, where a detected place helps."""
    if not detected:
        return diagnosis
    near = [place for place in detected if place.ln_bayes_factor > detected[0].ln_bayes_factor - LEAD]
    confirmed = competition.confirmed(near)
    if confirmed is not None:
        return _named(diagnosis, competition.case, confirmed)
    preferred = competition.preferred(detected)
    return diagnosis if preferred is None else _unknown(diagnosis, search, near, preferred)


@dataclass(frozen=True, eq=False)
class _Confirmed:
    """A mechanism that one half prefers and all samples confirm: its ln Bayes factor on all, and its gains."""

    name: str
    ln_bayes_factor: float
    gains: tuple[Gain, ...]


@dataclass(frozen=True, eq=False)
class _Preferred:
    """The curves on the searched half with the place that it prefers, and the gains on the other."""

    traces: tuple[Trace, ...]
    gains: tuple[Gain, ...]


@dataclass(frozen=True, eq=False)
class _Competition:
    """The places of all samples, given the names of the library."""

    case: SearchedRecording
    conditions: Conditions
    ranked: RankedPlaces

    def detected(self, diagnosis: Diagnosis) -> list[FittedPlace]:
        """Return the best detected place of each region where the name does not act, that explains more than it."""
        kinds = (self.case.library[cause.name].kind for cause in diagnosis.mechanisms)
        named = frozenset(region for kind in kinds for region in regions_of(kind))
        names = {cause.name for cause in diagnosis.mechanisms}
        factors = [self._factor(effects) for effects in self.case.explanations if names.issuperset(effects)]
        least = max([self.case.rules.detected, *(factors if names else ())])
        return [
            place
            for region, place in self.ranked.by_region().items()
            if region not in named and place.ln_bayes_factor >= least
        ]

    def _factor(self, effects: Effects) -> float:
        """Return the ln Bayes factor of effects on all samples."""
        refit = self.case.refit(effects)
        return -np.inf if refit is None else refit.log_evidence - self.ranked.baseline.log_evidence

    def confirmed(self, near: Sequence[FittedPlace]) -> _Confirmed | None:
        """Return the best mechanism of the library's search if it acts on a near region and explains as much."""
        (name,) = self.case.findings.evidences.single
        if not regions_of(self.case.library[name].kind) & {place.region for place in near}:
            return None
        factor = self._factor((name,))
        if factor < max(self.case.rules.detected, near[0].ln_bayes_factor - LEAD):
            return None
        extension = partial(hypothesis, effects=(self.case.library[name],))
        gains = self._gains(extension, self.case.findings.explanation((name,)))
        return None if gains is None else _Confirmed(name, factor, gains)

    def preferred(self, detected: Sequence[FittedPlace]) -> _Preferred | None:
        """Return the curves and gains of the place that the searched half prefers; None where it does not help."""
        case = self.case
        half = PlaceSearch(FitContext(case.data), case.model, case.findings.survey.baseline)
        fits = (half.fitted_from(place.kind, place.explanation.fit.x) for place in detected)
        refits = [fit for fit in fits if fit is not None]
        if not refits:
            return None
        choice = max(refits, key=lambda place: place.ln_bayes_factor)
        gains = self._gains(partial(place_hypothesis, kind=choice.kind), choice.explanation)
        return None if gains is None else _Preferred(case.traces(choice.explanation), gains)

    def _gains(self, extension: Extension, explained: Explanation) -> tuple[Gain, ...] | None:
        """Return the gains of an extension fitted to the searched half; None where a held-out test shows none."""
        tests = predict_extension(self.case, extension, explained.fit.x, self.conditions)
        if not all(test and test.helps() for test in tests):
            return None
        return tuple(gain for test in tests if test for gain in test.gains())


def _named(diagnosis: Diagnosis, case: SearchedRecording, confirmed: _Confirmed) -> Diagnosis:
    """Return the diagnosis of a mechanism whose evidence on one half was too small to name it."""
    effects = (confirmed.name,)
    cause = replace(case.cause(effects, confirmed.name), ln_bayes_factor=confirmed.ln_bayes_factor)
    return replace(
        diagnosis,
        verdict="named",
        mechanisms=(cause,),
        candidate=None,
        alternatives=(),
        next_measurement="",
        gain=confirmed.gains,
        withdrawn=_withdrawn(diagnosis),
        traces=case.traces(case.findings.explanation(effects)),
        from_all_samples=case.sizes_from_all_samples([effects]),
    )


def _withdrawn(diagnosis: Diagnosis) -> tuple[str, ...]:
    return (*diagnosis.withdrawn, *(cause.name for cause in diagnosis.mechanisms))


def _unknown(
    diagnosis: Diagnosis, search: PlaceSearch, near: Sequence[FittedPlace], preferred: _Preferred
) -> Diagnosis:
    """Return the diagnosis of an unknown effect that acts on the best region, or on one of those near it."""
    shown = [ShownPlace.from_search(search, place) for place in near]
    return replace(
        diagnosis,
        verdict="unknown",
        mechanisms=(),
        candidate=None,
        alternatives=(),
        from_all_samples=(),
        withdrawn=_withdrawn(diagnosis),
        gain=preferred.gains,
        traces=preferred.traces,
        acting=tuple(place.acting() for place in shown),
        functions=tuple(place.function() for place in shown),
    )
