"""Atrial surge: an atrial systole that is stronger or weaker than the standard kick."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import bump
from heartfit.roles import Pressure, mechanism


@mechanism
@dataclass(frozen=True)
class AtrialSurge(Pressure):
    r"""A bump of the atrial pressures beyond the kick of the heart, the fraction :math:`\rho` of it on the right.

    .. math:: p(t) = a \cos^2 \frac{\pi (t - t_a)}{w} \quad \text{for } |t - t_a| < \tfrac{w}{2}

    A hypertrophied atrium gives more, a > 0; one that is stunned or fibrillates less, a < 0, down to none at all.
    Source: the booster function of the atrium in Hoit, J Am Coll Cardiol 2014, 63:493.
    """

    compartments = ("left_atrium", "right_atrium")
    rise: float = parameter(
        600.0,
        unit="Pa",
        symbol="a",
        meaning="left atrial pressure beyond the standard kick",
        off=0.0,
        low=-3000.0,
        scale=600.0,
    )
    peak: float = parameter(0.11, unit="s", symbol="t_a", meaning="time of the maximum", scale=0.02)
    width: float = parameter(0.16, unit="s", symbol="w", meaning="length, foot to foot", low=0.02)
    right: float = parameter(0.27, unit="1", symbol=r"\rho", meaning="right atrial rise over the left one")

    def __post_init__(self) -> None:
        require_admissible(self)

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        share = {"left_atrium": 1.0, "right_atrium": self.right}[compartment]
        return share * self.rise * bump(time, self.peak, self.width, period)
