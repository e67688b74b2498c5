"""Atrial systole: the pressure bump that tops up the ventricles before they contract."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Contraction, mechanism

NORMAL_RISE = 1700.0
"""Rise [Pa] of a contraction of one."""


@mechanism
@dataclass(frozen=True)
class AtrialKick(Contraction):
    r"""Bump of the atrial pressures at the beginning of the cycle.

    .. math:: p(t) = P \begin{cases} \sin^2 \frac{\pi t}{2 t_m} & 0 \le t < t_m \\
              \cos^2 \frac{\pi (t - t_m)}{2 (t_c - t_m)} & t_m \le t < t_c \end{cases}

    in the left atrium, and the fraction :math:`\rho` of it in the right one. An atrium with a volume contracts by its
    active elastance instead, as :math:`e(t) = p(t) / 1700` Pa.
    Source: the atrial parameters (base, maximum, times) of the paper's group; the shape is ours.
    """

    compartments = ("left_atrium", "right_atrium")
    rise: float = parameter(
        NORMAL_RISE, unit="Pa", symbol="P", meaning="left atrial pressure rise", sd=0.3, off=0.0, scale=600.0
    )
    right: float = parameter(
        0.27, unit="1", symbol=r"\rho", meaning="right atrial rise over the left one", sd=0.3
    )
    peak: float = parameter(0.14, unit="s", symbol="t_m", meaning="time of the maximum")
    end: float = parameter(0.20, unit="s", symbol="t_c", meaning="end of atrial systole")

    def __post_init__(self) -> None:
        require_admissible(self)
        if not 0.0 < self.peak < self.end:
            raise ValueError(
                f"AtrialKick peaks at {self.peak:g} s and ends at {self.end:g} s: expected 0 < peak < end"
            )

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        share = {"left_atrium": 1.0, "right_atrium": self.right}[compartment]
        return share * self.rise * self._shape(np.mod(time, period))

    def contraction(self, time: Floats, period: float) -> Floats:
        return self.rise / NORMAL_RISE * self._shape(np.mod(time, period))

    def _shape(self, time: Floats) -> Floats:
        """Bump of height one at ``time`` [s] within the period."""
        rising = np.sin(0.5 * np.pi * time / self.peak) ** 2
        falling = np.cos(0.5 * np.pi * (time - self.peak) / (self.end - self.peak)) ** 2
        return np.where(time < self.peak, rising, np.where(time < self.end, falling, 0.0))
