"""A place on the card: the function that its law makes, its clear phases, and the laws that it may follow."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from heartfit.discovery.sphere_model.forward_model import BASE_COORDINATES, SphereForwardModel
from heartfit.discovery.sphere_model.law_ranking import FittedLaw
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.place_search import FittedPlace, PlaceSearch
from heartfit.discovery.sphere_model.shown_place import ShownPlace, _coefficients
from heartfit.places import Place
from heartfit.places.laws import Law
from heartfit.places.library import (
    AorticLoss,
    AorticPressure,
    AtrialPressure,
    LeakFlow,
    LeakPassage,
    MitralLoss,
)
from heartfit.places.place import FunctionOfTime
from heartfit.places.wall import WallPressure
from heartfit.roles.laws import BLOOD_DENSITY

BASE = len(BASE_COORDINATES)

PERIOD = 0.8


def place(kind: type[Place], factor: float, z: float = 0.5) -> FittedPlace:
    x = np.concatenate([np.zeros(BASE), np.full(kind.size, z)])
    return FittedPlace(kind, cast("object", SimpleNamespace(fit=SimpleNamespace(x=x))), factor)  # type: ignore[arg-type]


def searching() -> PlaceSearch:
    model = SphereForwardModel(ADULT, {})
    return cast("PlaceSearch", SimpleNamespace(model=model, base=BASE, period=ADULT.heart.period))


@pytest.mark.parametrize(
    ("law", "form", "flow", "sign"),
    [
        (LeakPassage, LeakFlow, "LeakPassage", None),
        (MitralLoss, AtrialPressure, "mitral", -1.0),
        (AorticLoss, AorticPressure, "aortic", 1.0),
    ],
)
def test_the_function_of_a_law_is_what_it_adds_in_its_beat(
    law: type[Place], form: type[FunctionOfTime], flow: str, sign: float | None
) -> None:
    """A flow, or the loss 1/2 rho a q^2, which lowers the pressure of the atrium and raises that of the aorta."""
    search, fitted = searching(), place(law, 10.0)
    coefficients = _coefficients(search, fitted, form)
    assert coefficients is not None
    _, beat = search.model.simulate(
        np.zeros(BASE), (law.from_standardised(np.full(law.size, 0.5), search.period),)
    ) or (
        None,
        None,
    )
    assert beat is not None
    added = beat.flow[flow]
    if sign is not None:
        added = sign * 0.5 * BLOOD_DENSITY * 0.5 * law.amplitude * np.maximum(added, 0.0) ** 2
    values = form.from_standardised(coefficients, search.period).function.at(beat.time)
    assert np.sqrt(np.mean((values - added) ** 2)) < 0.2 * np.sqrt(np.mean(added**2)), "eight harmonics"
    assert np.corrcoef(values, added)[0, 1] > 0.97


def test_a_free_function_starts_from_its_linear_model() -> None:
    assert _coefficients(searching(), place(WallPressure, 10.0), WallPressure) is None


def test_the_clear_spans_of_a_function_follow_the_trigger() -> None:
    """A function that is clear from 0.2 to 0.3 s after the trigger, and about the end of the beat."""
    times = np.arange(200) * PERIOD / 200
    after = np.mod(times - 0.1, PERIOD)
    mean = np.where((after > 0.2) & (after < 0.3), 5e-5, np.where(after > 0.75, -3e-5, 1e-6))
    law = Law("orifice", "A", "m^2", 2e-5, np.ones((1, 200)))
    place_shown = ShownPlace(
        place(LeakPassage, 12.0), LeakFlow, times, after, mean, np.full(200, 1e-5),
        (FittedLaw(law, -4.0, 0, 2e-5), FittedLaw(law, -9.0, 0, 1e-5)),
    )  # fmt: skip
    acting, function = place_shown.acting(), place_shown.function()
    first, second = acting.spans
    assert (first.size, second.size) == (5e-5, -3e-5)
    assert (first.start, first.end) == pytest.approx((0.2, 0.3), abs=0.005)
    assert (second.start, second.end) == pytest.approx((0.75, 0.8), abs=0.005)
    assert [one.ln_likelihood for one in acting.laws] == [0.0, -5.0]
    assert np.all(np.diff(function.times) > 0.0)
    assert function.mean[(function.times > 0.21) & (function.times < 0.29)] == pytest.approx(5e-5)
    assert function.law == pytest.approx(2e-5)
