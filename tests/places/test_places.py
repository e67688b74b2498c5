"""Free functions, and the places of the equations and of the measurement at which they act."""

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.forward_model import NUMERICS, SphereForwardModel
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.geometry.territory import ACTIVATION_ORDER, RIGHT_VENTRICLE
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.mitral_stenosis import MitralStenosis
from heartfit.mechanisms.septal_load import SeptalLoad
from heartfit.places import PLACES, REGIONS, Place, regions_of
from heartfit.places.cosines import COSINES, CosineFunction, cosine_deviations
from heartfit.places.laws import LawState, laws_of
from heartfit.places.library import AorticPressure, AtrialPressure, LeakFlow, LeakPassage, MitralLoss
from heartfit.places.periodic import COEFFICIENTS, PeriodicFunction, wave_deviations
from heartfit.places.place import AMPLITUDES, FunctionOfState, FunctionOfTime
from heartfit.places.wall import ActivationDelay, AttachmentRate, DetachmentRate, WallElasticity, WallPressure
from heartfit.roles import Mechanism, registered
from heartfit.roles.laws import Load
from heartfit.roles.sides import acts_within
from heartfit.synthetic.out_of_library import SeptalDefect

PERIOD = ADULT.heart.period
TIMES = np.arange(400) * PERIOD / 400
AT_MEAN = np.zeros(len(FREE_PARAMETERS))
LENGTH = 0.05


def predicted(*mechanisms: Mechanism) -> Floats:
    curves = SphereForwardModel(ADULT, {"lv_volume": TIMES, "lv_pressure": TIMES}).predict(
        AT_MEAN, mechanisms
    )
    assert curves is not None
    return curves


def drawn(place: type[Place], seed: int = 3) -> Place:
    z = 0.3 * np.random.default_rng(seed).standard_normal(place.size)
    return place.from_standardised(np.abs(z) if place.one_sided else z, PERIOD)


def test_a_function_is_periodic_and_returns_its_harmonics() -> None:
    z = np.random.default_rng(1).standard_normal(COEFFICIENTS)
    function = PeriodicFunction(z, PERIOD)
    assert function.at(TIMES + 3.0 * PERIOD) == pytest.approx(function.at(TIMES))
    assert PeriodicFunction.from_samples(function.at(TIMES), PERIOD).coefficients == pytest.approx(z)
    assert function.at(TIMES.reshape(4, 100)).shape == (4, 100)
    place = WallPressure.from_standardised(z, PERIOD)
    assert place.standardised() == pytest.approx(z)
    assert WallPressure.basis(TIMES, PERIOD) @ z == pytest.approx(place.function.at(TIMES))


def test_the_integral_of_a_function_is_that_of_its_values() -> None:
    function = PeriodicFunction(np.random.default_rng(2).standard_normal(COEFFICIENTS), PERIOD)
    fine = np.linspace(0.0, 0.6, 6001)
    values = function.at(fine)
    expected = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1])) * 1e-4])
    assert function.integral(fine) == pytest.approx(expected, abs=1e-5)


def test_the_prior_has_unit_variance_and_the_correlation_of_a_gaussian() -> None:
    """Periodic, as the sum of exp(-t^2 / (2 l^2)) over all beats, which eight harmonics resolve to a hundredth."""
    deviations = wave_deviations(PERIOD, LENGTH)
    basis = np.stack([PeriodicFunction(row, PERIOD).at(TIMES) for row in np.diag(deviations)])
    covariance = basis.T @ basis
    assert np.diag(covariance) == pytest.approx(np.ones(TIMES.size))
    beats = PERIOD * np.arange(-2, 3)[:, None]
    expected = np.exp(-0.5 * ((TIMES + beats) / LENGTH) ** 2).sum(axis=0)
    assert covariance[0] == pytest.approx(expected, abs=0.01)
    assert covariance[0, 40] == pytest.approx(covariance[200, 240]), "stationary"


def test_a_function_of_a_state_has_unit_variance_and_the_slope_of_its_values() -> None:
    u = np.linspace(0.0, 1.0, 2001)
    basis = np.stack([CosineFunction(row).at(u) for row in np.diag(cosine_deviations(0.25))])
    assert np.mean(np.sum(basis**2, axis=0)) == pytest.approx(1.0, abs=1e-3)
    function = CosineFunction(np.random.default_rng(4).standard_normal(COSINES))
    assert function.slope_at(u[1:-1]) == pytest.approx(np.gradient(function.at(u), u)[1:-1], abs=0.02)
    beyond = np.array([-0.5, 1.5])
    assert function.at(beyond) == pytest.approx(function.at(np.array([0.0, 1.0]))), "keeps its last value"
    assert not function.slope_at(beyond).any()


def test_two_functions_never_look_alike() -> None:
    """Beats are stored by the representation of their mechanisms."""
    third, following = np.full(COEFFICIENTS, 1.0 / 3.0), np.full(COEFFICIENTS, np.nextafter(1.0 / 3.0, 1.0))
    assert repr(PeriodicFunction(third, PERIOD)) != repr(PeriodicFunction(following, PERIOD))
    assert repr(PeriodicFunction(third, PERIOD)) != repr(PeriodicFunction(third, np.nextafter(PERIOD, 1.0)))
    assert repr(CosineFunction(third)) != repr(CosineFunction(following))


@pytest.mark.parametrize("place", PLACES)
def test_a_place_at_zero_changes_no_bit(place: type[Place]) -> None:
    np.testing.assert_array_equal(
        predicted(place.from_standardised(np.zeros(place.size), PERIOD)), predicted()
    )


@pytest.mark.parametrize("place", PLACES)
def test_a_place_acts_in_its_own_region_and_is_no_candidate_of_the_library(place: type[Place]) -> None:
    assert regions_of(place) == {place.region}
    assert place.__name__ not in registered()
    change = predicted(drawn(place)) - predicted()
    assert np.abs(change[:400]).max() > 1e-7 or np.abs(change[400:]).max() > 10.0


@pytest.mark.parametrize("place", PLACES)
def test_the_first_prior_of_every_place_is_that_of_its_coefficients(place: type[Place]) -> None:
    """Among the amplitudes is 1, so that one prior is N(0, I); longer ones have less of the fast coefficients."""
    deviations = place.deviations(PERIOD)
    assert deviations.shape[1] == place.size
    assert any(np.allclose(row, 1.0) for row in deviations)
    if issubclass(place, FunctionOfTime | FunctionOfState):
        assert deviations.shape[0] == len(AMPLITUDES) * len(place.LENGTHS)


def test_every_region_has_a_place() -> None:
    assert {place.region for place in PLACES} == set(REGIONS)


def test_every_mechanism_of_the_left_heart_has_a_region() -> None:
    without = {name for name, kind in registered().items() if not regions_of(kind)}
    assert without == {name for name, kind in registered().items() if not acts_within(kind, 1)} | {
        "RightAtrium"
    }
    assert {"TricuspidRegurgitation", "PulmonaryStenosis", "LateRightWall"} < without
    assert regions_of(SeptalDefect) == {"leak"}, "it leaves the left ventricle"


@pytest.mark.parametrize(
    ("name", "region"),
    [
        ("MitralStenosis", "filling"),
        ("AorticStenosis", "ejection"),
        ("ArterialReflection", "ejection"),
        ("MitralRegurgitation", "leak"),
        ("AorticRegurgitation", "backflow"),
        ("Pericardium", "wall"),
        ("WallViscosity", "wall"),
        ("SlowRelaxation", "muscle"),
        ("LengthDependence", "muscle"),
        ("ImageShrinkage", "images"),
        ("CatheterOffset", "catheter"),
    ],
)
def test_a_mechanism_acts_where_its_role_acts(name: str, region: str) -> None:
    assert regions_of(registered()[name]) == {region}


@pytest.mark.parametrize(
    ("place", "law"), [(WallPressure, SeptalLoad(1000.0)), (AorticPressure, ArterialReflection(1000.0))]
)
def test_a_place_with_the_course_of_a_mechanism_has_its_beat(place: type[FunctionOfTime], law) -> None:  # type: ignore[no-untyped-def]
    """The function keeps the lowest harmonics of the mechanism's pulse."""
    pulse = (
        law.load("lv", TIMES, PERIOD).pulse
        if isinstance(law, SeptalLoad)
        else law.pressure("aorta", TIMES, PERIOD)
    )
    with_law, alone = predicted(law), predicted()
    gap = predicted(place(PeriodicFunction.from_samples(pulse, PERIOD))) - with_law
    effect = with_law - alone
    for rows in (slice(0, 400), slice(400, 800)):
        assert np.abs(gap[rows]).max() < 0.02 * np.abs(effect[rows]).max()


@pytest.mark.parametrize(
    ("place", "law"),
    [
        (LeakPassage(0.0, 0.2e-4), MitralRegurgitation(0.2e-4)),
        (MitralLoss(MitralStenosis().inverse_square()), MitralStenosis()),
    ],
)
def test_a_place_of_one_law_is_that_law(place: Place, law: Mechanism) -> None:
    np.testing.assert_array_equal(predicted(place), predicted(law))


@pytest.mark.parametrize("place", PLACES)
def test_the_sizes_of_a_place_are_those_of_laws_of_its_region(place: type[Place]) -> None:
    heart, beat = SphereForwardModel(ADULT, {}).simulate(AT_MEAN, ()) or (None, None)
    assert beat is not None
    assert heart is not None
    laws = {law.name for law in laws_of(place.region, LawState(beat.time, beat.signals(), beat.period))}
    sizes = drawn(place).sizes()
    assert set(sizes) <= laws
    assert bool(sizes) == place.one_sided


def test_a_flow_out_of_the_ventricle_takes_its_blood() -> None:
    """Over a beat the mitral valve passes what the aortic valve and the leak take: volume is conserved."""
    leak = np.zeros(COEFFICIENTS)
    leak[0] = 20e-6
    heart, beat = SphereForwardModel(ADULT, {}).simulate(
        AT_MEAN, (LeakFlow(PeriodicFunction(leak, PERIOD)),)
    ) or (
        None,
        None,
    )
    assert heart is not None
    assert beat is not None
    flows = {name: np.trapezoid(values, beat.time) for name, values in beat.flow.items()}
    assert flows["LeakFlow"] == pytest.approx(20e-6 * PERIOD, rel=1e-6)
    assert flows["mitral"] - flows["aortic"] == pytest.approx(flows["LeakFlow"], rel=0.02)


def test_negative_coefficients_of_a_passage_are_refused() -> None:
    for place in (LeakPassage, MitralLoss):
        with pytest.raises(ValueError, match="negative"):
            place.from_standardised(np.full(place.size, -0.1), PERIOD)


def test_bridges_that_attach_after_repolarisation_hold_the_pressure_up() -> None:
    control = ADULT.heart.tissue.control
    late = np.where(np.abs(TIMES - control.duration - 0.12) < 0.04, 0.8, 0.0)
    twitch = predicted(AttachmentRate(PeriodicFunction.from_samples(late, PERIOD)))
    gain = (twitch - predicted())[400:]
    assert gain.max() > 300.0
    assert (TIMES[int(np.argmax(gain))] + ADULT.heart.trigger) > control.onset + control.duration


def test_bridges_that_detach_more_slowly_hold_the_pressure_up() -> None:
    slow = np.zeros(COSINES)
    slow[0] = -0.5
    gain = (predicted(DetachmentRate(CosineFunction(slow))) - predicted())[400:]
    assert gain.max() > 300.0
    assert DetachmentRate(CosineFunction(slow)).missing_integral(np.array(0.2)) == pytest.approx(
        0.2 * -np.expm1(-0.5)
    )


def test_segments_that_are_late_prolong_contraction_and_the_first_stays() -> None:
    rising = np.zeros(COSINES)
    rising[1] = -0.03
    late = ActivationDelay(CosineFunction(rising))
    delays = late.delay()
    assert delays[[RIGHT_VENTRICLE, ACTIVATION_ORDER[0]]].tolist() == [0.0, 0.0]
    assert delays[ACTIVATION_ORDER[-1]] == pytest.approx(0.06)
    assert np.all(np.diff(delays[ACTIVATION_ORDER]) > 0.0)
    together = np.zeros(COSINES)
    together[0] = 0.05
    assert not ActivationDelay(CosineFunction(together)).delay().any(), (
        "the onset is a parameter of the heart"
    )
    slower = predicted(late)[400:]
    assert np.gradient(slower).max() < 0.9 * np.gradient(predicted()[400:]).max()


def test_the_energy_of_the_wall_has_the_slope_of_its_stress() -> None:
    wall = drawn(WallElasticity)
    assert isinstance(wall, WallElasticity)
    x = np.linspace(0.0, 1.4, 1401)
    first, second = wall.slopes(x)
    assert first[0] == 0.0, "the reference is free of stress"
    assert second[1:-1] == pytest.approx(np.gradient(first, x)[1:-1], rel=1e-2, abs=30.0)


def test_more_pressure_in_the_atrium_fills_the_ventricle() -> None:
    constant = np.zeros(COEFFICIENTS)
    constant[0] = 200.0
    raised = predicted(AtrialPressure(PeriodicFunction(constant, PERIOD)))
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
    assert wall.load("lv", TIMES, PERIOD).pulse == pytest.approx(wall.function.at(TIMES))
