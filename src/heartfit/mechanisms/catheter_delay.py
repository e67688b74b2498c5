"""Catheter delay: travel time of the pressure from the heart to the record."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import apply_filter
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class CatheterDelay(Sensor):
    r"""Left ventricular pressure delayed by :math:`d_p` in tubing and amplifier.

    .. math:: p'(t) = p(t - d_p), \qquad p'_k = e^{-2 \pi i k d_p / T} \, p_k

    for harmonic k of the period T. It is early, :math:`d_p < 0`, if the ECG that triggers is delayed more.
    Source: ours; the resonance of the same tubing is :class:`CatheterDamping
    <heartfit.mechanisms.catheter_damping.CatheterDamping>`.
    """

    measures = ("lv_pressure",)
    lag: float = parameter(
        0.01,
        unit="s",
        symbol="d_p",
        meaning="delay of the pressure",
        off=0.0,
        low=-0.5,
        scale=0.02,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return apply_filter(
            times, values, period, lambda frequency: np.exp(-2j * np.pi * frequency * self.lag)
        )
