"""Periodic curves: linear filters on their harmonics, and a cosine bump."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError

Response = Callable[[Floats], NDArray]
BEATS = (0.2, 3.0)
"""Periods of a human heart [s]: 300 to 20 beats a minute."""
SAMPLING_TOLERANCE = 1e-6
"""Spread of the sampling steps over the period up to which it counts as rounding."""


def apply_filter(times: Floats, values: Floats, period: float, response: Response) -> Floats:
    r"""Return the curve ``values`` (t,) at equidistant ``times`` (t,) [s] after a linear filter.

    .. math:: y'_k = H(k / T)\, y_k, \qquad y(t) = \sum_k y_k e^{2 \pi i k t / T},

    where ``response`` H maps frequencies [Hz] to complex gains, with H(0) real. Only the change
    :math:`(H - 1) y_k` is transformed, so that H = 1 returns the values bit for bit. Raises InputError
    for samples that are not equidistant over the whole ``period`` [s].
    """
    _require_equidistant(times, period)
    frequency: Floats = np.fft.rfftfreq(values.size, period / values.size).astype(np.float64)
    change = (response(frequency) - 1.0) * np.fft.rfft(values)
    result: Floats = values + np.fft.irfft(change, values.size)
    return result


def bump(time: Floats, centre: float, width: float, period: float) -> Floats:
    r"""Return a smooth bump of height one at ``time`` (any shape) [s], once in every ``period`` [s].

    .. math:: \cos^2 \frac{\pi (t - t_c)}{w} \quad \text{for } |t - t_c| < \frac{w}{2}, \quad 0 \text{ otherwise,}

    with ``centre`` :math:`t_c` and ``width`` w from foot to foot [s].
    """
    offset = np.mod(time - centre + 0.5 * period, period) - 0.5 * period
    return np.where(np.abs(offset) < 0.5 * width, np.cos(np.pi * offset / width) ** 2, 0.0)


def _require_equidistant(times: Floats, period: float) -> None:
    steps = np.diff(times, append=times[0] + period)
    if np.ptp(steps) > SAMPLING_TOLERANCE * period:
        raise InputError(
            f"curve: steps of {steps.min():g} to {steps.max():g} s; expected equidistant samples over the whole "
            f"period of {period:g} s to filter it: resample the curve"
        )
