"""What instruments make of true curves, and which instrument makes one curve of another."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from heartfit.mechanism import Sensor
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.observation.alignment import require_common_phase
from heartfit.observation.curve import Curve

SHRINKAGES = (-1.0, 0.99)
LONGEST = 0.25
"""Delay and smoothing, over the period, beyond which a curve is no longer recognised."""
START = 0.02
"""Smoothing, s, from which a fit starts: at zero the curve does not depend on it to first order."""


def as_measured(curves: Mapping[str, Curve], sensors: Sequence[Sensor]) -> dict[str, Curve]:
    """The curves, time zero at the trigger, as the sensors show them; what no sensor measures stays."""
    return {
        name: _through(curve, [each for each in sensors if name in each.measures])
        for name, curve in curves.items()
    }


def _through(curve: Curve, sensors: Sequence[Sensor]) -> Curve:
    values = curve.values
    for sensor in sensors:
        values = sensor.distort(curve.times, values, curve.period)
    return replace(curve, values=values)


def image_sensors(shrinkage: float, smoothing: float, delay: float) -> tuple[Sensor, ...]:
    """Scanner first, then registration, which takes the blurred and late first frame as its reference."""
    return ImageSmoothing(smoothing), ImageTriggerDelay(delay), ImageShrinkage(shrinkage)


def fit_sensors(true: Curve, registered: Curve) -> dict[str, float]:
    """Parameters of `image_sensors`, by name, SI, that carry the true volume curve to the registered one.

    Least squares over the samples of `registered`, bounded to |delay|, smoothing <= a quarter of the period.
    true: equidistant samples over its period (InputError otherwise), best much finer than the registered ones or at
    the same times, for it is taken linear between them. Raises ValueError if the periods differ by more than a tenth.
    """
    from scipy.optimize import least_squares

    require_common_phase(true, registered)
    stroke, longest = np.ptp(true.values), LONGEST * true.period

    def misfit(parameters: np.ndarray) -> np.ndarray:
        shown = _through(true, image_sensors(*parameters))
        return (shown(registered.times) - registered.values) / stroke

    low, high = np.array([SHRINKAGES, (0.0, longest), (-longest, longest)]).T
    found = least_squares(
        misfit, (0.0, START, 0.0), bounds=(low, high), x_scale=(0.1, START, START), xtol=1e-10
    )
    return dict(zip(("shrinkage", "smoothing", "delay"), found.x.tolist(), strict=True))
