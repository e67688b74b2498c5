"""Search for the place at which something unknown acts: in hearts of our own law, and of linear models."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.evidence import Fit
from heartfit.discovery.inference.hypothesis import Hypothesis
from heartfit.discovery.sphere_model.forward_model import BASE_COORDINATES
from heartfit.discovery.sphere_model.place_search import (
    PROMISE,
    SWITCHED_ON,
    PlaceSearch,
    RankedPlaces,
    place_hypothesis,
)
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.places import Place
from heartfit.places.library import AtrialPressure, LeakFlow, LeakPassage, MitralLoss, PressureError
from heartfit.places.wall import WallPressure
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import REST, plant
from heartfit.synthetic.hidden import RecordingProtocol, draw_hidden, measure_beat
from heartfit.synthetic.out_of_library import SeptalDefect

BASE = len(BASE_COORDINATES)
KINDS: tuple[type[Place], ...] = (AtrialPressure, MitralLoss, LeakPassage, PressureError, WallPressure)
LEAKING = PlantedPlan(520, "outside", ("SeptalDefect",), 3.0)
SOUND = PlantedPlan(604, "none", (), 0.0)


def searched(plan: PlantedPlan) -> tuple[PlaceSearch, RankedPlaces]:
    recording, _ = Recording.from_curves(plant(plan).curves[REST]).halves()
    problem = SphereProblem.from_recording(recording)
    search = PlaceSearch(FitContext(problem.data), problem.model, problem.fit())
    return search, search.run(KINDS)


@pytest.fixture(scope="module")
def leaking() -> tuple[PlaceSearch, RankedPlaces]:
    return searched(LEAKING)


def test_a_leak_that_no_law_of_the_library_makes_acts_as_a_leak(leaking) -> None:  # type: ignore[no-untyped-def]
    best, second = list(leaking[1].by_region().values())[:2]
    assert best.region == "leak"
    assert best.ln_bayes_factor > 5.0
    assert best.ln_bayes_factor > second.ln_bayes_factor + 3.0
    area = best.kind.from_standardised(best.explanation.fit.x[BASE:], leaking[0].period).area  # type: ignore[attr-defined]
    assert 0.1e-4 < area < 0.6e-4


def test_places_are_ranked_and_what_was_not_fitted_promises_little(leaking) -> None:  # type: ignore[no-untyped-def]
    places = leaking[1].places
    factors = [place.ln_bayes_factor for place in places]
    assert factors == sorted(factors, reverse=True)
    assert {place.kind for place in places} == set(KINDS)
    assert all(place.ln_bayes_factor <= PROMISE + 0.1 for place in places if not place.fitted)


def test_a_linear_model_that_was_not_fitted_counts_less_than_it_promises(leaking) -> None:  # type: ignore[no-untyped-def]
    """It promises ln likelihood, which is taken off, and a gain in the prior of the parameters, which counts."""
    search, _ = leaking
    screened = search._screened(LeakPassage)
    assert screened is not None
    assert screened.predicted > 5.0
    assert screened.ln_bayes_factor < screened.predicted - 1.0


def test_a_strong_leak_is_screened_where_it_is_switched_on() -> None:
    """The fit without it has other parameters, about which its linear model predicts nothing."""
    rng = np.random.default_rng(3)
    beat = draw_hidden(rng).with_effects([SeptalDefect(area=0.4e-4)]).beat()
    curves = measure_beat(beat, (), RecordingProtocol.draw(rng), rng)
    problem = SphereProblem.from_recording(Recording.from_curves(curves))
    search = PlaceSearch(FitContext(problem.data), problem.model, problem.fit())
    screened = search._screened(LeakPassage)
    assert screened is not None
    about_the_fit = search._judged(LeakPassage, screened.explanation, fitted=False)
    assert about_the_fit.predicted < 15.0 < screened.predicted
    assert search._fitted(screened).ln_bayes_factor > 15.0
    models = [search._at_centre(LeakPassage, size) for size in SWITCHED_ON]
    predicted = [search._judged(LeakPassage, model).predicted for model in models if model is not None]
    assert len(set(predicted)) == len(SWITCHED_ON)
    assert screened.predicted == pytest.approx(max(predicted))


def test_a_fitted_place_explains_no_less_than_the_model_without_it(leaking) -> None:  # type: ignore[no-untyped-def]
    search, ranked = leaking
    best = ranked.places[0].explanation.fit
    assert best.objective < search.baseline.fit.objective - 5.0
    assert search.context.simulations > 100, "counted"


def test_a_sound_heart_has_no_place() -> None:
    _, ranked = searched(SOUND)
    assert max(place.ln_bayes_factor for place in ranked.places) < 5.0


def test_places_stand_beside_the_better_fit_without_one(leaking) -> None:  # type: ignore[no-untyped-def]
    """A fit without a place that stopped early gives no place its evidence."""
    search, ranked = leaking
    baseline = search.baseline.fit
    start = baseline.x + 0.5
    early = search.context.linearise(baseline.hypothesis, start)
    assert early is not None
    early = replace(early, fit=replace(early.fit, objective=baseline.objective + 50.0))
    beside = PlaceSearch(search.context, search.model, early)._beside_base(ranked.places)
    assert beside.baseline.fit.objective < baseline.objective + 2.0
    gain = beside.baseline.log_evidence - early.log_evidence
    best = ranked.places[0]
    assert beside.places[0].kind is best.kind
    assert beside.places[0].ln_bayes_factor == pytest.approx(best.ln_bayes_factor - gain)


def test_a_place_is_fitted_anew_to_other_samples(leaking) -> None:  # type: ignore[no-untyped-def]
    search, ranked = leaking
    best = ranked.places[0]
    _, unseen = Recording.from_curves(plant(LEAKING).curves[REST]).halves()
    assert unseen is not None
    problem = SphereProblem.from_recording(unseen)
    other = PlaceSearch(FitContext(problem.data), problem.model, problem.fit()).fitted_from(
        best.kind, best.explanation.fit.x
    )
    assert other is not None
    assert other.explanation.fit.predicted.size == problem.data.values.size
    first, second = (
        one.kind.from_standardised(one.explanation.fit.x[BASE:], search.period).flow(0.0, 10e3)[0]  # type: ignore[attr-defined]
        for one in (best, other)
    )
    assert second == pytest.approx(first, rel=0.3)


def linear(search: PlaceSearch, kind: type[Place], jacobian: Floats) -> Fit:
    """A linear model about zero coordinates that predicts the baseline's curves."""
    hypothesis = place_hypothesis(search.model, kind)
    at = np.zeros(BASE + kind.size)
    return Fit(hypothesis, at, search.baseline.fit.predicted, jacobian, 0.0, converged=True)


def test_the_evidence_of_a_place_does_not_depend_on_where_its_linear_model_stands(leaking) -> None:  # type: ignore[no-untyped-def]
    """Also under priors of which some coefficients are ten million times as narrow as others."""
    search, _ = leaking
    rng = np.random.default_rng(5)
    jacobian = rng.standard_normal((search.baseline.fit.predicted.size, BASE + LeakFlow.size)) * 1e-6
    fit = linear(search, LeakFlow, jacobian)
    shift = 0.3 * rng.standard_normal(fit.x.size)
    elsewhere = replace(fit, x=shift, predicted=fit.predicted + jacobian @ shift)
    narrow = np.geomspace(1.0, 1e-7, LeakFlow.size)[None]
    (here,), (there,) = (list(search._evidences(one, narrow)) for one in (fit, elsewhere))
    assert there[0] == pytest.approx(here[0], abs=1e-4)


def test_the_hypothesis_of_a_place_begins_with_the_free_parameters(leaking) -> None:  # type: ignore[no-untyped-def]
    search, _ = leaking
    hypothesis: Hypothesis = place_hypothesis(search.model, LeakPassage)
    assert hypothesis.names[:BASE] == search.baseline.fit.hypothesis.names
    assert hypothesis.one_sided.tolist() == [False] * BASE + [True] * LeakPassage.size
    at_zero = hypothesis.forward(np.concatenate([search.baseline.fit.x, np.zeros(LeakPassage.size)]))
    assert at_zero == pytest.approx(search.baseline.fit.predicted)
