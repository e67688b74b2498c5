"""Observations of a beat or a recording, their noise, and the summary of a calibration."""

from collections.abc import Mapping, Sequence
from typing import Any, overload

import numpy as np

from heartfit.calibration.update import Posterior
from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import measure
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures
from heartfit.observation.operator import observe as observe_curves
from heartfit.roles import Sensor

FRAMES = 25
"""Frames of a cine sequence."""
OBSERVED = ("lv_volume", "lv_pressure")


@overload
def observe(
    source: Beat, *, frames: int = FRAMES, sensors: Sequence[Sensor] = ()
) -> dict[str, float] | str: ...


@overload
def observe(
    source: Recording | Mapping[str, Curve], *, frames: int = FRAMES, sensors: Sequence[Sensor] = ()
) -> dict[str, float]: ...


def observe(
    source: Beat | Recording | Mapping[str, Curve], *, frames: int = FRAMES, sensors: Sequence[Sensor] = ()
) -> dict[str, float] | str:
    """Observe a beat or a recording: observations by name [SI], or the reason of a failed beat.

    V_min [m^3], q_max and q_min [m^3/s] of the left volume at ``frames`` equidistant times, and P_max [Pa], dPdt_max
    and dPdt_min [Pa/s] of the left pressure, where there is one. Both sides of a calibration are observed with the same
    ``frames``: more than a recording has make its rates incomparable. sensors: instruments among the mechanisms of a
    simulated heart. Source: Marchesseau et al., MICCAI 2012, section 3.
    """
    if isinstance(source, Beat) and not source.completed:
        return source.reason
    curves = _curves(source, sensors)
    return observe_curves(curves, _features(curves, frames))


def observation_noise(
    recording: Recording,
    volume_sd: float,
    pressure_sd: float | None = None,
    *,
    frames: int = FRAMES,
    period_uncertainty: float = 0.05,
) -> Floats:
    """Covariance R (m, m) of the observations of a recording, diagonal, in the order and the units of :func:`observe`.

    volume_sd [m^3], pressure_sd [Pa]: standard deviation of a sample; period_uncertainty: relative standard deviation
    of the period, which scales every rate. By 1000 perturbed curves. Raises InputError for a recorded pressure without
    its deviation.
    """
    curves = _curves(recording, ())
    deviations = {"lv_volume": volume_sd, "lv_pressure": pressure_sd}
    variances: list[float] = []
    for name, operator in _features(curves, frames).items():
        sd = deviations[name]
        if sd is None:
            raise InputError(
                "observation_noise: the recording has lv_pressure; expected pressure_sd in Pa: state it"
            )
        perturbed = measure(operator, curves[name], sd, period_uncertainty)
        variances += [observation.noise**2 for observation in perturbed]
    return np.diag(variances)


def _curves(source: Beat | Recording | Mapping[str, Curve], sensors: Sequence[Sensor]) -> dict[str, Curve]:
    if isinstance(source, Beat):
        return beat_curves(source, sensors)
    if isinstance(source, Recording):
        return {name: source.curve(name) for name in source.curves}
    return dict(source)


def _features(curves: Mapping[str, Curve], frames: int) -> dict[str, CurveFeatures]:
    operators = zip(OBSERVED, (VolumeFeatures(frames), PressureFeatures()), strict=True)
    return {name: operator for name, operator in operators if name == OBSERVED[0] or name in curves}


def summary(posterior: Posterior) -> Any:
    """Table of the estimated parameters as a pandas.DataFrame: one row each [SI].

    prior, median: of the parameter before and after; low, high: 95 % interval; informed: share of the prior's variance
    (of the logarithm) that the data have removed.
    """
    from pandas import DataFrame

    estimate, prior = posterior.estimate, posterior.prior
    reach = 1.96 * estimate.sd
    return DataFrame(
        {
            "prior": np.exp(prior.mean),
            "median": np.exp(estimate.mean),
            "low": np.exp(estimate.mean - reach),
            "high": np.exp(estimate.mean + reach),
            "informed": 1.0 - (estimate.sd / prior.sd) ** 2,
        },
        index=list(estimate.names),
    )
