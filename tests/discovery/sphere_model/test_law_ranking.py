"""The law that a function follows, from the posterior of its coefficients alone."""

import numpy as np
import pytest
from scipy.integrate import quad

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.law_ranking import SCALES, FunctionPosterior, _marginal
from heartfit.places.laws import Law
from heartfit.places.library import LeakFlow
from heartfit.places.periodic import PeriodicFunction

PERIOD = 0.9
TIMES = np.arange(200) * PERIOD / 200
BUMP = np.exp(-0.5 * ((TIMES - 0.3) / 0.08) ** 2)
LATE = np.exp(-0.5 * ((TIMES - 0.6) / 0.08) ** 2)


def observed(values: Floats, noise: float, seed: int = 1) -> FunctionPosterior:
    """Posterior of a function of which the samples at TIMES are measured with this noise [m^3/s]."""
    basis = LeakFlow.basis(TIMES, PERIOD)
    measured = values + noise * np.random.default_rng(seed).standard_normal(TIMES.size)
    precision = np.eye(LeakFlow.size) + basis.T @ basis / noise**2
    covariance = np.linalg.inv(precision)
    return FunctionPosterior(LeakFlow, covariance @ basis.T @ measured / noise**2, covariance, PERIOD)


def law(name: str, *curves: Floats, one_sided: bool = True) -> Law:
    shapes = tuple({"centre": float(index)} for index in range(len(curves)))
    return Law(name, "f", "m^2", 2e-5, np.array(curves), shapes, one_sided)


def test_the_marginal_likelihood_is_the_integral_over_the_size() -> None:
    informed, b, sd = 3.0, 4.0, 0.7

    def density(theta: float) -> float:
        prior = np.exp(-0.5 * (theta / sd) ** 2) / (sd * np.sqrt(2.0 * np.pi))
        return float(np.exp(b * theta - 0.5 * informed * theta**2) * prior)

    both = np.log(quad(density, -20.0, 20.0)[0])
    positive = np.log(2.0 * quad(density, 0.0, 20.0)[0])
    one, other = (_marginal(np.array([informed]), np.array([b]), sd, side)[0] for side in (False, True))
    assert one == pytest.approx(both, abs=1e-6)
    assert other == pytest.approx(positive, abs=1e-6)


@pytest.mark.parametrize("size", [1e-4, 4e-5])
def test_the_right_law_comes_first_with_its_size(size: float) -> None:
    posterior = observed(size * BUMP, 8e-6)
    right, wrong = law("right", BUMP), law("wrong", LATE)
    first, second = posterior.rank([wrong, right])
    assert first.law is right
    assert first.ln_likelihood > second.ln_likelihood + 5.0
    assert first.size == pytest.approx(size, rel=0.1)
    assert first.values == pytest.approx(first.size * BUMP)
    assert second.size < 0.3 * size


def test_a_law_finds_its_shape_and_pays_for_the_others() -> None:
    posterior = observed(6e-5 * LATE, 8e-6)
    exact, searched = law("exact", LATE), law("searched", BUMP, LATE, np.roll(LATE, 60))
    first, second = posterior.rank([searched, exact])
    assert first.law is exact
    assert second.shape == 1
    assert first.ln_likelihood - second.ln_likelihood == pytest.approx(np.log(3.0), abs=0.2)


def test_a_one_sided_law_takes_no_negative_size() -> None:
    posterior = observed(-6e-5 * BUMP, 8e-6)
    (one,), (other,) = posterior.rank([law("a", BUMP)]), posterior.rank([law("b", BUMP, one_sided=False)])
    assert one.size == 0.0
    assert other.size == pytest.approx(-6e-5, rel=0.1)
    assert other.ln_likelihood > one.ln_likelihood + 5.0


def test_nothing_observed_prefers_no_law() -> None:
    prior = FunctionPosterior(LeakFlow, np.zeros(LeakFlow.size), np.eye(LeakFlow.size), PERIOD)
    ranked = prior.rank([law("a", BUMP), law("b", LATE, BUMP, one_sided=False)])
    assert [one.ln_likelihood for one in ranked] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert len(SCALES) > 1


def test_the_band_is_that_of_the_coefficients() -> None:
    posterior = observed(5e-5 * BUMP, 8e-6)
    mean, sd = posterior.values(TIMES)
    drawn = np.random.default_rng(3).multivariate_normal(posterior.mean, posterior.covariance, 4000)
    values = np.array([LeakFlow.from_standardised(z, PERIOD).function.at(TIMES) for z in drawn[:400]])
    assert values.mean(axis=0) == pytest.approx(mean, abs=3e-6)
    assert values.std(axis=0) == pytest.approx(sd, rel=0.2)
    assert np.abs(mean - 5e-5 * BUMP).max() < 4.0 * sd.max()
    function = PeriodicFunction.from_samples(mean, PERIOD)
    assert function.at(TIMES) == pytest.approx(mean)
