"""Image smoothing: frames that last, and a registration that is smooth in time."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import apply_filter
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class ImageSmoothing(Sensor):
    r"""Volume curve averaged over a Gaussian window of standard deviation :math:`\tau`.

    .. math:: V'(t) = \int \frac{e^{-u^2 / 2 \tau^2}}{\sqrt{2 \pi} \tau} V(t - u) \, du, \qquad
              V'_k = e^{-(2 \pi k \tau / T)^2 / 2} \, V_k

    for harmonic k of the period T; the mean volume stays. A frame acquired evenly during w has
    :math:`\tau = w / \sqrt{12}`, 12 ms for 40 ms.
    Source: the acquisition window of segmented cine (Atkinson and Edelman, Radiology 1991, 178:357); the Gaussian
    shape is ours.
    """

    measures = ("lv_volume", "rv_volume")
    smoothing: float = parameter(
        0.015,
        unit="s",
        symbol=r"\tau_V",
        meaning="standard deviation of the time window",
        sd=0.5,
        off=0.0,
        scale=0.035,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return apply_filter(
            times,
            values,
            period,
            lambda frequency: np.exp(-0.5 * (2 * np.pi * frequency * self.smoothing) ** 2),
        )
