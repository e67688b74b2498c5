"""Calibrated cases for other programs: groups of ArviZ InferenceData, and tidy tables.

Prior and posterior are Gaussians of the logarithms of the parameters. ``constant_data`` has their mean and covariance;
``prior`` and ``posterior`` have seeded draws, because programs that read this format expect draws. Predictive draws
follow by the linear map of the unscented transform, with the noise of the observations.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.update import Posterior, long_steps
from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement
from heartfit.results.case import CaseResult
from heartfit.results.text import curve_unit


@dataclass(frozen=True, eq=False)
class Calibrated:
    """A case with its noise-free and its noise-aware update.

    noise_free: as in the paper; noise_aware: with the noise of the observations; measured, simulated: curves by name
    (SI), simulated at the noise-free estimate, empty for a failed beat.
    """

    case: CaseResult
    noise_free: Posterior
    noise_aware: Posterior
    measurement: Measurement
    measured: Mapping[str, Curve]
    simulated: Mapping[str, Curve]

    @property
    def beliefs(self) -> dict[str, Gaussian]:
        """Return the Gaussians of the ln parameters: prior, noise-free step of the paper, noise-aware posterior."""
        return {
            "prior": self.noise_free.prior,
            "paper": self.noise_free.estimate,
            "posterior": self.noise_aware.estimate,
        }

    def predicted(self, z: Floats) -> Floats:
        r"""Return observations (.., m) at ln parameters z (.., n) by the linear map of the transform.

        .. math:: \bar Z + \mathrm{Cov}(Z, X)\, C^{-1} (z - z_0)
        """
        prior = self.noise_aware.prior
        slopes = np.linalg.solve(prior.covariance, self.noise_aware.cov_xz)
        return self.noise_aware.predicted + (z - prior.mean) @ slopes


CHAINS, DRAWS, SEED = 4, 250, 20120101
GAUSSIAN_COMMENT = "Gaussian of the natural logarithms of the parameters, SI"
DRAWS_COMMENT = (
    f"{CHAINS * DRAWS} independent seeded draws of the Gaussian in constant_data, without a Markov chain"
)
PREDICTIVE_COMMENT = "by the linear map of the unscented transform, with the noise of the observations"


@dataclass(frozen=True, eq=False)
class _Draws:
    """Draws of a Gaussian: ln parameters z (c, d, n), and the observations y (c, d, m) predicted from them."""

    belief: Gaussian
    z: Floats
    y: Floats


def inference_groups(calibrated: Calibrated) -> dict[str, xr.Dataset]:
    """Return the datasets by the names of their groups."""
    rng = np.random.default_rng(SEED)
    prior, posterior = (_draw(calibrated, calibrated.beliefs[name], rng) for name in ("prior", "posterior"))
    return {
        "posterior": _parameter_draws(calibrated, posterior),
        "posterior_predictive": _predictive_draws(calibrated, posterior),
        "prior": _parameter_draws(calibrated, prior),
        "prior_predictive": _predictive_draws(calibrated, prior),
        "sample_stats": _density(posterior),
        "predictions": _simulated(calibrated.simulated),
        "observed_data": _observed(calibrated),
        "constant_data": _gaussians(calibrated),
    }


def _draw(calibrated: Calibrated, belief: Gaussian, rng: np.random.Generator) -> _Draws:
    z = rng.multivariate_normal(belief.mean, belief.covariance, (CHAINS, DRAWS))
    exact = calibrated.predicted(z)
    noise = rng.multivariate_normal(
        np.zeros(exact.shape[-1]), calibrated.measurement.covariance, (CHAINS, DRAWS)
    )
    return _Draws(belief, z, exact + noise)


def _parameter_draws(calibrated: Calibrated, drawn: _Draws) -> xr.Dataset:
    values = dict(zip(drawn.belief.names, np.moveaxis(np.exp(drawn.z), -1, 0), strict=True))
    return _draws_dataset(
        {name: _variable(draws, calibrated.case.units[name]) for name, draws in values.items()}, DRAWS_COMMENT
    )


def _predictive_draws(calibrated: Calibrated, drawn: _Draws) -> xr.Dataset:
    values = zip(calibrated.measurement.observations, np.moveaxis(drawn.y, -1, 0), strict=True)
    return _draws_dataset(
        {observation.name: _variable(draws, observation.unit) for observation, draws in values},
        PREDICTIVE_COMMENT,
    )


def _density(drawn: _Draws) -> xr.Dataset:
    """Return ln density of each draw."""
    deviation, covariance = drawn.z - drawn.belief.mean, drawn.belief.covariance
    square = np.einsum("cdi,ij,cdj->cd", deviation, np.linalg.inv(covariance), deviation)
    volume = np.linalg.slogdet(2.0 * np.pi * covariance)[1]
    return _draws_dataset({"lp": _variable(-0.5 * (square + volume), "1")}, GAUSSIAN_COMMENT)


def _draws_dataset(variables: Mapping[str, Any], comment: str) -> xr.Dataset:
    axes = {"chain": np.arange(CHAINS), "draw": np.arange(DRAWS)}
    return xr.Dataset(variables, axes, {"comment": comment, "seed": SEED})


def _variable(values: Floats, unit: str, dims: tuple[str, ...] = ("chain", "draw")) -> Any:
    return dims, values, {"units": unit}


def _simulated(curves: Mapping[str, Curve]) -> xr.Dataset:
    variables: dict[str, Any] = {}
    for name, (_, values, unit) in _curves(curves).items():
        dims = ("chain", "draw", f"{name}_time")
        variables[name] = (dims, values[None, None], unit)
    data = xr.Dataset(variables, {"chain": [0], "draw": [0], **_times(curves)})
    return data.assign_attrs(comment="one simulated beat at the noise-free estimate; empty if it failed")


def _observed(calibrated: Calibrated) -> xr.Dataset:
    numbers = {
        observation.name: ((), observation.value, {"units": observation.unit})
        for observation in calibrated.measurement.observations
    }
    data = xr.Dataset({**numbers, **_curves(calibrated.measured)}, _times(calibrated.measured))
    return data.assign_attrs(comment="measured observations including bias, and the measured curves")


def _curves(curves: Mapping[str, Curve]) -> dict[str, Any]:
    return {
        name: _variable(curve.values, curve_unit(name), (f"{name}_time",)) for name, curve in curves.items()
    }


def _times(curves: Mapping[str, Curve]) -> dict[str, Any]:
    attributes = {"units": "s", "long_name": "time after the trigger"}
    return {f"{name}_time": ((f"{name}_time",), curve.times, attributes) for name, curve in curves.items()}


def _gaussians(calibrated: Calibrated) -> xr.Dataset:
    """Return mean and covariance of each Gaussian, and of the noise of the observations."""
    variables: dict[str, Any] = {}
    for name, belief in calibrated.beliefs.items():
        variables[f"{name}_mean"] = _variable(belief.mean, "1", ("parameter",))
        variables[f"{name}_covariance"] = _variable(belief.covariance, "1", ("parameter", "parameter_bis"))
    names = list(calibrated.measurement.values)
    bias = np.array([observation.bias for observation in calibrated.measurement.observations])
    variables["observation_bias"] = ("observation", bias, {"units": "SI"})
    square = ("observation", "observation_bis")
    variables["observation_covariance"] = (square, calibrated.measurement.covariance, {"units": "SI"})
    parameters = list(calibrated.noise_free.prior.names)
    axes = {
        "parameter": parameters,
        "parameter_bis": parameters,
        "observation": names,
        "observation_bis": names,
    }
    return xr.Dataset(variables, axes, {"comment": f"{GAUSSIAN_COMMENT}; paper: noise-free update"})


INTERVAL_WIDTH = 1.959964
"""Half width of the 95 % interval of a Gaussian [standard deviations]."""


def parameters_table(cases: Sequence[Calibrated]) -> pd.DataFrame:
    """Return median and 95 % interval of each parameter by Gaussian, and the standard deviation of its logarithm.

    long_step: the median is too far from the prior's mean for one straight step, see `heartfit.calibration.update`.
    """
    return pd.DataFrame([row for calibrated in cases for row in _belief_rows(calibrated)])


def curves_table(cases: Sequence[Calibrated]) -> pd.DataFrame:
    """Return each sample of the measured and of the calibrated curves."""
    return pd.DataFrame([row for calibrated in cases for row in _sample_rows(calibrated)])


def _belief_rows(calibrated: Calibrated) -> Iterator[dict[str, Any]]:
    prior = calibrated.noise_free.prior
    for belief_name, belief in calibrated.beliefs.items():
        long = long_steps(prior.names, (belief.mean - prior.mean) / prior.sd)
        for name, mean, sd in zip(belief.names, belief.mean, belief.sd, strict=True):
            median, low, high = np.exp(mean + INTERVAL_WIDTH * sd * np.array([0.0, -1.0, 1.0]))
            value = {"median": median, "low": low, "high": high, "sd_of_ln": sd}
            row = {"belief": belief_name, "parameter": name, **value, "unit": calibrated.case.units[name]}
            row["long_step"] = "yes" if name in long else ""
            yield _key(calibrated) | row


def _sample_rows(calibrated: Calibrated) -> Iterable[dict[str, Any]]:
    for kind, curves in (("measured", calibrated.measured), ("calibrated", calibrated.simulated)):
        for name, curve in curves.items():
            unit = curve_unit(name)
            for time, value in zip(curve.times, curve.values, strict=True):
                row = {"kind": kind, "curve": name, "time_s": time, "value": value, "unit": unit}
                yield _key(calibrated) | row


def _key(calibrated: Calibrated) -> dict[str, Any]:
    return {"case": calibrated.case.case, "setting": calibrated.case.setting}
