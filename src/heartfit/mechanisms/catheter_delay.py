"""Catheter delay: the time a pressure takes from the heart to the record."""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Sensor, mechanism
from heartfit.parameter import parameter, require_admissible
from heartfit.periodic import filtered


@mechanism
@dataclass(frozen=True)
class CatheterDelay(Sensor):
    r"""Left ventricular pressure that is late by :math:`d_p`: through tubing and amplifier.

    .. math:: p'(t) = p(t - d_p), \qquad p'_k = e^{-2 \pi i k d_p / T} \, p_k

    for harmonic k of the period T. Early, :math:`d_p < 0`, it is where the ECG that triggers is later still.
    Source: ours; the resonance of the same tubing is :class:`CatheterDamping
    <heartfit.mechanisms.catheter_damping.CatheterDamping>`.
    """

    measures = ("lv_pressure",)
    lag: float = parameter(
        0.01,
        unit="s",
        symbol="d_p",
        meaning="by how much the pressure seems late",
        off=0.0,
        low=-0.5,
        scale=0.02,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return filtered(times, values, period, lambda frequency: np.exp(-2j * np.pi * frequency * self.lag))
