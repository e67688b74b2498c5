"""The sphere with functions inside its equations, fitted to an earlier recording, and changes since."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.discovery.inference.decide import CHANGE_RULES
from heartfit.discovery.sphere_model.diagnose import diagnose, diagnose_change
from heartfit.discovery.sphere_model.earlier import BASE, CHANGE_SCALES, EarlierHeart
from heartfit.discovery.sphere_model.forward_model import candidates
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.heart import Heart
from heartfit.io.other_worlds import read_other_hearts
from heartfit.places import EARLIER_PLACES, Place
from heartfit.places.wall import WallPressure
from heartfit.roles import Sensor
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.other_worlds import OtherHeart, measure
from tests.discovery.sphere_model.hearts import LEAK, recorded

BANK = Path(__file__).parents[3] / "resources" / "other_worlds"
AT_MEAN = np.zeros(BASE)
pytestmark = pytest.mark.usefixtures("coarse_search")


@pytest.fixture(scope="module")
def hearts() -> tuple[OtherHeart, OtherHeart]:
    """A heart of another simulator, healthy and with a severe mitral regurgitation."""
    bank = read_other_hearts(BANK / "regazzoni.csv")
    ill = next(one for one in bank if (one.illness, one.severity) == ("mitral regurgitation", "severe"))
    return next(one for one in bank if one.seed == ill.seed and not one.illness), ill


@pytest.fixture(scope="module")
def before(hearts: tuple[OtherHeart, OtherHeart]) -> Recording:
    return Recording.from_curves(measure(hearts[0]))


@pytest.fixture(scope="module")
def earlier(before: Recording, coarse_search: None) -> EarlierHeart:
    return EarlierHeart.from_recording(before)


def error(problem: SphereProblem, curve: int) -> float:
    """Root mean square residual [SI] of a curve at the mean of the priors."""
    predicted = problem.model.predict(AT_MEAN, ())
    assert predicted is not None
    left = (problem.data.values - predicted)[problem.data.rows[curve]]
    return float(np.sqrt(np.mean(left**2)))


@pytest.mark.long
def test_functions_fit_the_heart_of_another_simulator_to_its_noise(
    before: Recording, earlier: EarlierHeart
) -> None:
    """Noise of 1 to 3 % of the end-diastolic volume, and of 0.1 kPa."""
    problem = SphereProblem.from_recording(before, earlier.nominal)
    assert error(problem, 0) < 0.03 * before.end_diastolic_volume()
    assert error(problem, 1) < 150.0
    assert error(problem, 0) < 2.0 * earlier.levels["lv_volume"][0]
    assert error(problem, 1) < 2.0 * earlier.levels["lv_pressure"][0]
    bare = [m for m in earlier.nominal.heart.mechanisms if not isinstance(m, Place)]
    without = replace(earlier.nominal, heart=replace(earlier.nominal.heart, mechanisms=tuple(bare)))
    assert error(SphereProblem.from_recording(before, without), 1) > 300.0, "without its functions"


def test_the_fitted_heart_holds_all_functions(earlier: EarlierHeart) -> None:
    kinds = {type(mechanism) for mechanism in earlier.nominal.heart.mechanisms}
    assert kinds >= set(EARLIER_PLACES)
    assert earlier.nominal.stands_for == "change"
    assert earlier.at_period(earlier.nominal.heart.period) == earlier.nominal


def test_at_another_rate_the_functions_follow_the_phases(earlier: EarlierHeart) -> None:
    """Values at the activation, in the middle and at the end of the action potential, and 50 ms later."""
    slow, fast = earlier.nominal.heart, earlier.at_period(0.9 * earlier.nominal.heart.period).heart

    def values(heart: Heart) -> np.ndarray:
        control = heart.tissue.control
        marks = control.onset + control.duration * np.array([0.0, 0.5, 1.0])
        times = np.append(marks, marks[-1] + 0.05)
        (wall,) = (one for one in heart.mechanisms if isinstance(one, WallPressure))
        return wall.function.at(times)

    assert fast.tissue.control.duration < slow.tissue.control.duration
    assert values(fast) == pytest.approx(values(slow), abs=300.0), "of some 10 kPa, kept by eight harmonics"
    assert np.ptp(values(slow)) > 3000.0


def test_small_changes_of_the_functions_have_the_covariance_of_their_beats(
    before: Recording, earlier: EarlierHeart
) -> None:
    """The squares of twenty changes of 2 % have their means on the diagonal of s^2 S."""
    problem = SphereProblem.from_recording(before, earlier.nominal, earlier)
    assert problem.data.structure is not None
    assert problem.data.scales == CHANGE_SCALES
    same = problem.model.predict(AT_MEAN, ())
    assert same is not None
    scale, draws, period = 0.02, np.random.default_rng(5), before.period
    squares = np.zeros(same.size)
    present = {type(one): one for one in earlier.nominal.heart.mechanisms if isinstance(one, Place)}
    fitted = np.concatenate([present[place].standardised() for place in EARLIER_PLACES])
    for _ in range(20):
        z = fitted + scale * draws.standard_normal(fitted.size)
        parts = zip(EARLIER_PLACES, np.split(z, len(EARLIER_PLACES)), strict=True)
        changed = problem.model.predict(
            AT_MEAN, [place.from_standardised(part, period) for place, part in parts]
        )
        assert changed is not None
        squares += (changed - same) ** 2 / 20
    for rows in problem.data.rows:
        expected = scale**2 * np.diag(problem.data.structure)[rows].sum()
        assert squares[rows].sum() == pytest.approx(expected, rel=0.4)


def test_later_the_instruments_are_the_same(before: Recording, earlier: EarlierHeart) -> None:
    problem = SphereProblem.from_recording(before, earlier.nominal, earlier)
    assert not [one for one in candidates(problem.model).values() if issubclass(one.kind, Sensor)]
    for block in problem.data.blocks:
        assert block.noise.levels == earlier.levels[block.curve]
        assert 1 <= len(block.noise.levels) <= 2
    assert CHANGE_RULES.beside_structure(CHANGE_SCALES[0]) == CHANGE_RULES, "functions raise no threshold"


@pytest.mark.long
@pytest.mark.usefixtures("few_mechanisms")
def test_a_leak_since_an_earlier_recording_is_named() -> None:
    diagnosis = diagnose_change(recorded(LEAK), recorded(PlantedPlan(1, "none")))
    assert {cause.name for cause in diagnosis.mechanisms} == {"MitralRegurgitation"}


@pytest.mark.usefixtures("few_mechanisms")
def test_a_leak_of_another_simulator_is_named_against_its_healthy_beat(
    hearts: tuple[OtherHeart, OtherHeart], before: Recording, earlier: EarlierHeart
) -> None:
    """Its valves, elastances and arteries are not ours."""
    nominal = earlier.at_period(before.period)
    ill = diagnose(
        Recording.from_curves(measure(hearts[1])), nominal=nominal, rules=CHANGE_RULES, structure=earlier
    )
    assert {cause.name for cause in ill.mechanisms} == {"MitralRegurgitation"}
    unchanged = diagnose(before, nominal=nominal, rules=CHANGE_RULES, structure=earlier)
    assert unchanged.verdict == "none"
    assert unchanged.mechanisms == ()
    assert unchanged.changes == ()
