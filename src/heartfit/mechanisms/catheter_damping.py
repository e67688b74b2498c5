"""Catheter damping: a fluid column on an elastic dome, which overshoots or lags behind the pressure."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import apply_filter
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class CatheterDamping(Sensor):
    r"""Left ventricular pressure at the end of a fluid-filled catheter, an oscillator of the second order.

    .. math:: r^2 \ddot p' + 2 \zeta r \dot p' + p' = p, \qquad
              H(f) = \frac{1}{1 + 2 i \zeta x - x^2}, \quad x = 2 \pi f r,

    with natural frequency :math:`f_n = 1 / (2 \pi r)` and damping ratio :math:`\zeta`; periodic, hence its steady
    oscillation. Below :math:`f_n` it is a delay of :math:`2 \zeta r`. Lines in use have 10 to 25 Hz, that is
    r = 6 to 16 ms, and :math:`\zeta` of 0.1 to 0.5.
    Source: Gardner, Direct blood pressure measurement, Anesthesiology 1981, 54:227.
    """

    measures = ("lv_pressure",)
    response: float = parameter(
        0.0106,
        unit="s",
        symbol="r",
        meaning="response time, 1 / (2 pi natural frequency)",
        sd=0.3,
        off=0.0,
        scale=0.015,
    )
    damping: float = parameter(0.3, unit="1", symbol=r"\zeta", meaning="damping ratio", sd=0.4, low=0.01)

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return apply_filter(times, values, period, self._gain)

    def _gain(self, frequency: Floats) -> NDArray:
        x = 2.0 * np.pi * frequency * self.response
        return 1.0 / (1.0 + 2j * self.damping * x - x**2)
