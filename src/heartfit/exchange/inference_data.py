r"""A calibrated case in the groups of ArviZ's InferenceData.

Prior and posterior are Gaussians of the logarithms of the parameters. They stand in ``constant_data`` as mean and
covariance and, because programs of this form expect draws, in ``prior`` and ``posterior`` as seeded draws of exactly
them. Predictive draws follow by the linear map of the unscented transform, with the noise of the observations.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from heartfit.calibration.gaussian import Gaussian
from heartfit.exchange.calibrated import Calibrated
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve

CHAINS, DRAWS, SEED = 4, 250, 20120101
UNITS = {"volume": "m^3", "pressure": "Pa", "flow": "m^3/s"}
"""Of curves by the last word of their names."""
LOGARITHMS = "Gaussian of the natural logarithms of the parameters, SI"
DRAWN = (
    f"{CHAINS * DRAWS} seeded draws of the Gaussian in constant_data: no chain was run, all are independent"
)
LINEAR = "by the linear map of the unscented transform, with the noise of the observations"


@dataclass(frozen=True, eq=False)
class _Drawn:
    """Logarithms of the parameters z (c, d, n) of a belief, and the observations y (c, d, m) that it predicts."""

    belief: Gaussian
    z: Floats
    y: Floats


def groups(found: Calibrated) -> dict[str, xr.Dataset]:
    """The datasets by the names of their groups."""
    rng = np.random.default_rng(SEED)
    prior, posterior = (_draw(found, found.beliefs[name], rng) for name in ("prior", "posterior"))
    return {
        "posterior": _parameters(found, posterior),
        "posterior_predictive": _predictive(found, posterior),
        "prior": _parameters(found, prior),
        "prior_predictive": _predictive(found, prior),
        "sample_stats": _density(posterior),
        "predictions": _simulated(found.simulated),
        "observed_data": _observed(found),
        "constant_data": _gaussians(found),
    }


def _draw(found: Calibrated, belief: Gaussian, rng: np.random.Generator) -> _Drawn:
    z = rng.multivariate_normal(belief.mean, belief.covariance, (CHAINS, DRAWS))
    exact = found.predicted(z)
    noise = rng.multivariate_normal(np.zeros(exact.shape[-1]), found.measurement.covariance, (CHAINS, DRAWS))
    return _Drawn(belief, z, exact + noise)


def _parameters(found: Calibrated, drawn: _Drawn) -> xr.Dataset:
    values = dict(zip(drawn.belief.names, np.moveaxis(np.exp(drawn.z), -1, 0), strict=True))
    return _of_draws({name: _variable(each, found.case.units[name]) for name, each in values.items()}, DRAWN)


def _predictive(found: Calibrated, drawn: _Drawn) -> xr.Dataset:
    values = zip(found.measurement.observations, np.moveaxis(drawn.y, -1, 0), strict=True)
    return _of_draws({about.name: _variable(each, about.unit) for about, each in values}, LINEAR)


def _density(drawn: _Drawn) -> xr.Dataset:
    """ln of the density of each draw."""
    away, covariance = drawn.z - drawn.belief.mean, drawn.belief.covariance
    square = np.einsum("cdi,ij,cdj->cd", away, np.linalg.inv(covariance), away)
    volume = np.linalg.slogdet(2.0 * np.pi * covariance)[1]
    return _of_draws({"lp": _variable(-0.5 * (square + volume), "1")}, LOGARITHMS)


def _of_draws(variables: Mapping[str, Any], comment: str) -> xr.Dataset:
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
    return data.assign_attrs(comment="one simulated beat, at the mean of the paper's step; none if it failed")


def _observed(found: Calibrated) -> xr.Dataset:
    numbers = {each.name: ((), each.value, {"units": each.unit}) for each in found.measurement.observations}
    data = xr.Dataset({**numbers, **_curves(found.measured)}, _times(found.measured))
    return data.assign_attrs(
        comment="observations as they were measured, bias included, and the curves behind them"
    )


def _curves(curves: Mapping[str, Curve]) -> dict[str, Any]:
    return {
        name: _variable(curve.values, UNITS[name.rsplit("_", 1)[1]], (f"{name}_time",))
        for name, curve in curves.items()
    }


def _times(curves: Mapping[str, Curve]) -> dict[str, Any]:
    about = {"units": "s", "long_name": "time after the trigger"}
    return {f"{name}_time": ((f"{name}_time",), curve.times, about) for name, curve in curves.items()}


def _gaussians(found: Calibrated) -> xr.Dataset:
    """Mean and covariance of every belief, and of the noise of the observations."""
    variables: dict[str, Any] = {}
    for name, belief in found.beliefs.items():
        variables[f"{name}_mean"] = _variable(belief.mean, "1", ("parameter",))
        variables[f"{name}_covariance"] = _variable(belief.covariance, "1", ("parameter", "parameter_bis"))
    names = list(found.measurement.values)
    bias = np.array([each.bias for each in found.measurement.observations])
    variables["observation_bias"] = ("observation", bias, {"units": "SI"})
    square = ("observation", "observation_bis")
    variables["observation_covariance"] = (square, found.measurement.covariance, {"units": "SI"})
    parameters = list(found.met.prior.names)
    axes = {
        "parameter": parameters,
        "parameter_bis": parameters,
        "observation": names,
        "observation_bis": names,
    }
    return xr.Dataset(variables, axes, {"comment": f"{LOGARITHMS}; paper: observations met without noise"})
