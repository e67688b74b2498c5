"""Free functions of time, and the places of the equations at which they act."""

import numpy as np
import pytest

from heartfit.discovery.sphere_model.forward_model import NUMERICS, SphereForwardModel
from heartfit.discovery.sphere_model.nominal_heart import ADULT, FREE_PARAMETERS
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.mechanisms.septal_load import SeptalLoad
from heartfit.places import (
    COEFFICIENTS,
    PLACES,
    AorticPressure,
    AtrialPressure,
    PeriodicFunction,
    WallPressure,
)
from heartfit.places.periodic import LENGTH, Place, prior_deviations
from heartfit.roles import registered
from heartfit.roles.laws import Load

PERIOD = 0.86
TIMES = np.arange(400) * PERIOD / 400
AT_MEAN = np.zeros(len(FREE_PARAMETERS))


def predicted(*places: Place) -> np.ndarray:
    curves = SphereForwardModel(ADULT, {"lv_volume": TIMES, "lv_pressure": TIMES}).predict(AT_MEAN, places)
    assert curves is not None
    return curves


def test_a_function_is_periodic_and_returns_its_harmonics() -> None:
    z = np.random.default_rng(1).standard_normal(COEFFICIENTS)
    function = PeriodicFunction(z)
    assert function.at(TIMES + 3.0 * PERIOD, PERIOD) == pytest.approx(function.at(TIMES, PERIOD))
    assert PeriodicFunction.from_samples(function.at(TIMES, PERIOD)).coefficients == pytest.approx(z)
    assert function.at(TIMES.reshape(4, 100), PERIOD).shape == (4, 100)
    assert WallPressure.from_standardised(z, PERIOD).standardised(PERIOD) == pytest.approx(z)


def test_the_prior_has_unit_variance_and_the_correlation_of_a_gaussian() -> None:
    """Periodic, as the sum of exp(-t^2 / (2 l^2)) over all beats, which eight harmonics resolve to a hundredth."""
    basis = np.stack([PeriodicFunction(row).at(TIMES, PERIOD) for row in np.diag(prior_deviations(PERIOD))])
    covariance = basis.T @ basis
    assert np.diag(covariance) == pytest.approx(np.ones(TIMES.size))
    beats = PERIOD * np.arange(-2, 3)[:, None]
    expected = np.exp(-0.5 * ((TIMES + beats) / LENGTH) ** 2).sum(axis=0)
    assert covariance[0] == pytest.approx(expected, abs=0.01)
    assert covariance[0, 40] == pytest.approx(covariance[200, 240]), "stationary"


def test_two_functions_never_look_alike() -> None:
    """Beats are stored by the representation of their mechanisms."""
    first = PeriodicFunction(np.full(COEFFICIENTS, 1.0 / 3.0))
    second = PeriodicFunction(np.full(COEFFICIENTS, np.nextafter(1.0 / 3.0, 1.0)))
    assert repr(first) != repr(second)


@pytest.mark.parametrize("place", PLACES)
def test_a_place_at_zero_changes_no_bit(place: type[Place]) -> None:
    np.testing.assert_array_equal(
        predicted(place.from_standardised(np.zeros(COEFFICIENTS), PERIOD)), predicted()
    )


@pytest.mark.parametrize("place", PLACES)
def test_a_place_is_no_candidate_of_the_library(place: type[Place]) -> None:
    assert place.__name__ not in registered()


@pytest.mark.parametrize(
    ("place", "law"), [(WallPressure, SeptalLoad(1000.0)), (AorticPressure, ArterialReflection(1000.0))]
)
def test_a_place_with_the_course_of_a_mechanism_has_its_beat(place: type[Place], law) -> None:  # type: ignore[no-untyped-def]
    """The function keeps the lowest harmonics of the mechanism's pulse."""
    pulse = (
        law.load("lv", TIMES, PERIOD).pulse
        if isinstance(law, SeptalLoad)
        else law.pressure("aorta", TIMES, PERIOD)
    )
    with_law, alone = predicted(law), predicted()
    gap = predicted(place(PeriodicFunction.from_samples(pulse))) - with_law
    effect = with_law - alone
    for rows in (slice(0, 400), slice(400, 800)):
        assert np.abs(gap[rows]).max() < 0.02 * np.abs(effect[rows]).max()


def test_more_pressure_in_the_atrium_fills_the_ventricle() -> None:
    constant = np.zeros(COEFFICIENTS)
    constant[0] = 200.0
    raised = predicted(AtrialPressure(PeriodicFunction(constant)))
    higher = ADULT.heart.with_parameters({"circulation.left_atrium": 1100.0})
    expected = SphereForwardModel(
        ADULT.__class__(higher, ADULT.cavity, ADULT.wall, ADULT.filled, ADULT.inertia), {"lv_volume": TIMES}
    ).predict(AT_MEAN, ())
    assert expected is not None
    assert raised[:400] == pytest.approx(expected, abs=2e-7), "a constant is a resting pressure"
    assert NUMERICS.drift < 1e-4


def test_the_pressure_on_the_wall_acts_on_the_left_ventricle_alone() -> None:
    wall = WallPressure.from_standardised(np.ones(COEFFICIENTS), PERIOD)
    assert wall.load("rv", TIMES, PERIOD) == Load()
    assert wall.load("lv", TIMES, PERIOD).pulse == pytest.approx(wall.function.at(TIMES, PERIOD))
