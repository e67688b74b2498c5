"""Descent of the base: ventricles that pull at the atria as they contract."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import bump
from heartfit.roles import Pressure, mechanism


@mechanism
@dataclass(frozen=True)
class BaseDescent(Pressure):
    r"""The x descent and the v wave of the atrial pressure, with the fraction :math:`\rho` of both on the right.

    .. math:: p(t) = a\,\Big[ b\Big(\frac{t - t_v}{w}\Big) - b\Big(\frac{t - t_x}{w}\Big) \Big], \qquad
              b(s) = \cos^2 \pi s \quad \text{for } |s| < \tfrac12

    As the base descends it enlarges the atria and lowers their pressure; the blood that they draw in meanwhile raises
    it until the atrioventricular valves open, and falls into the ventricles at once.
    Source: the phases of atrial function in Hoit, J Am Coll Cardiol 2014, 63:493.
    """

    compartments = ("left_atrium", "right_atrium")
    swing: float = parameter(
        500.0,
        unit="Pa",
        symbol="a",
        meaning="depth of the x descent and height of the v wave in the left atrium",
        sd=0.5,
        off=0.0,
        scale=500.0,
    )
    descent: float = parameter(0.30, unit="s", symbol="t_x", meaning="time of the x descent")
    refilled: float = parameter(0.56, unit="s", symbol="t_v", meaning="time of the v wave", scale=0.02)
    width: float = parameter(
        0.26, unit="s", symbol="w", meaning="length of each, foot to foot", sd=0.2, low=0.05
    )
    right: float = parameter(0.5, unit="1", symbol=r"\rho", meaning="right atrial swing over the left one")

    def __post_init__(self) -> None:
        require_admissible(self)

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        share = {"left_atrium": 1.0, "right_atrium": self.right}[compartment]
        wave, descent = (bump(time, peak, self.width, period) for peak in (self.refilled, self.descent))
        return share * self.swing * (wave - descent)
