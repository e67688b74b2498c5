"""The groups hold the Gaussians in the form that ArviZ reads."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from heartfit.io.exchange import write_inference_data
from heartfit.results.exchange import CHAINS, DRAWS, inference_groups

COUNT = CHAINS * DRAWS


@pytest.fixture(scope="module")
def groups(calibrated):
    return inference_groups(calibrated)


def drawn(group, names):
    return np.stack([group[name].values.ravel() for name in names], axis=-1)


@pytest.mark.parametrize("about", ["prior", "posterior"])
def test_draws_have_the_mean_and_covariance_that_stand_beside_them(groups, about):
    logarithms = np.log(drawn(groups[about], ("sigma_0", "mu")))
    mean, covariance = (
        groups["constant_data"][f"{about}_{moment}"].values for moment in ("mean", "covariance")
    )
    sd = np.sqrt(np.diag(covariance))
    assert logarithms.mean(axis=0) == pytest.approx(mean, abs=4.0 * sd.max() / np.sqrt(COUNT))
    assert np.cov(logarithms.T) == pytest.approx(covariance, abs=6.0 * sd.max() ** 2 / np.sqrt(COUNT))


def test_predictive_draws_follow_by_the_linear_map_with_the_noise(groups, calibrated):
    belief = calibrated.noise_aware.estimate
    slopes = np.array([[-10e-6, 40e-6], [2e-6, -30e-6]])
    exact = np.array([60e-6, 400e-6]) + (belief.mean - calibrated.noise_aware.prior.mean) @ slopes
    spread = slopes.T @ belief.covariance @ slopes + calibrated.measurement.covariance
    noise = drawn(groups["posterior_predictive"], ("V_min", "q_max")) - exact
    sd = np.sqrt(np.diag(spread))
    assert np.all(np.abs(noise.mean(axis=0)) < 4.0 * sd / np.sqrt(COUNT))
    assert np.cov((noise / sd).T) == pytest.approx(spread / np.outer(sd, sd), abs=0.15)


def test_the_density_is_that_of_each_draw(groups, calibrated):
    belief = calibrated.noise_aware.estimate
    logarithms = np.log(drawn(groups["posterior"], belief.names))
    expected = multivariate_normal(belief.mean, belief.covariance).logpdf(logarithms)
    assert groups["sample_stats"]["lp"].values.ravel() == pytest.approx(expected)


def test_the_file_is_read_by_arviz_with_units_and_the_same_to_the_byte(calibrated, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the refactoring itself
        import arviz

    files = [tmp_path / folder / "inference.nc" for folder in ("one", "two")]
    for file in files:
        write_inference_data(file, calibrated.case, inference_groups(calibrated))
    assert files[0].read_bytes() == files[1].read_bytes()
    data = arviz.from_netcdf(str(files[0]))
    assert {"posterior", "prior", "observed_data", "posterior_predictive", "sample_stats"} <= set(
        data.groups()
    )
    assert data.posterior["mu"].attrs["units"] == "Pa.s"
    assert data.posterior.attrs["fingerprint"] == "0123"
    assert float(arviz.summary(data)["r_hat"].max()) < 1.02
    assert float(data.observed_data["lv_volume"].max()) == pytest.approx(1.4e-4)
    assert data.predictions["lv_volume"].dims == ("chain", "draw", "lv_volume_time")
    data.close()


def test_a_beat_that_failed_leaves_no_prediction(calibrated):
    assert not inference_groups(replace(calibrated, simulated={}))["predictions"].data_vars
