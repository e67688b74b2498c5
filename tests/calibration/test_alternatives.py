"""The ensemble smoother and CMA-ES find the closed form of a linear map, from their seed alone."""

from itertools import islice

import numpy as np
import pytest

from heartfit.calibration.alternatives import has_cma, minimise_by_cma_es, smooth_ensemble
from heartfit.calibration.unscented import CachedForward, CalibrationError, CountedForward
from heartfit.core.errors import InputError
from tests.calibration.maps import NOISE, failing, forward_of, kalman, named, random_prior, slopes

PRIOR, A = random_prior(4, 5), slopes(4, 5)
OBSERVED = A @ PRIOR.mean + np.array([0.2, -0.1, 0.1])
LINEAR = forward_of(PRIOR, lambda x: A @ x)
MEAN, COVARIANCE = kalman(PRIOR, A, OBSERVED)


def test_many_members_have_mean_and_covariance_of_the_posterior() -> None:
    forward = CountedForward(LINEAR)
    ensemble = smooth_ensemble(PRIOR, forward, named(OBSERVED), NOISE, 4000, seed=1)
    assert forward.simulations == 16000
    assert (ensemble.mean(axis=0) - MEAN) / PRIOR.sd == pytest.approx(np.zeros(4), abs=0.03)
    scaled = (np.cov(ensemble.T) - COVARIANCE) / np.outer(PRIOR.sd, PRIOR.sd)
    assert np.abs(scaled).max() < 0.03


def test_failed_members_are_excluded_and_too_few_are_reported() -> None:
    assert smooth_ensemble(PRIOR, failing(LINEAR, [0, 21]), named(OBSERVED), NOISE, 20, seed=1).shape == (
        18,
        4,
    )
    with pytest.raises(CalibrationError, match="2 of 20 members"):
        smooth_ensemble(PRIOR, failing(LINEAR, range(18)), named(OBSERVED), NOISE, 20, seed=1)


def test_the_same_seed_is_the_same_ensemble() -> None:
    first, again, other = (
        smooth_ensemble(PRIOR, LINEAR, named(OBSERVED), NOISE, 10, seed) for seed in (1, 1, 2)
    )
    assert (first == again).all()
    assert not (first == other).any()


@pytest.mark.skipif(not has_cma(), reason="the extra `alternatives` is not installed")
def test_cma_es_finds_the_maximum_a_posteriori_past_failures() -> None:
    estimates = [
        list(islice(minimise_by_cma_es(PRIOR, failing(LINEAR, [0, 9]), named(OBSERVED), NOISE, seed=1), 60))
        for _ in range(2)
    ]
    assert (estimates[0][-1] - MEAN) / PRIOR.sd == pytest.approx(np.zeros(4), abs=1e-3)
    assert np.array_equal(*estimates)


def test_without_the_package_cma_es_names_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("heartfit.calibration.alternatives.has_cma", lambda: False)
    with pytest.raises(InputError, match=r"pip install 'heartfit\[alternatives\]'"):
        next(minimise_by_cma_es(PRIOR, LINEAR, named(OBSERVED), NOISE, seed=1))


def test_completed_simulations_are_not_repeated() -> None:
    counted = CountedForward(LINEAR)
    forward = CachedForward(counted)
    one, two = PRIOR.physical(), PRIOR.physical(PRIOR.mean + 1.0)
    assert forward([one, two, one]) == [*LINEAR([one, two]), *LINEAR([one])]
    assert forward([two]) == LINEAR([two])
    assert counted.simulations == 2
