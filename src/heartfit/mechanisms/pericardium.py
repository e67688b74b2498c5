"""Pericardium: a sac that presses on ventricles that grow."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import External, mechanism
from heartfit.roles.laws import Load


@mechanism
@dataclass(frozen=True)
class Pericardium(External):
    r"""Pressure around both ventricles that rises exponentially with their mean volume.

    .. math:: p = a\, e^{(\bar V - V_0) / v}, \qquad \bar V = \tfrac12 (V_{LV} + V_{RV}),

    a being the pressure in the sac at :math:`V_0` = 150 mL; for a left ventricle alone :math:`\bar V` is its own
    volume, as if a right one beat in step with it.
    Source: the exponential of Freeman and Little, Am J Physiol 1986, 251:H421; the effect of the sac on filling is
    reviewed by Tyberg and Smith, Herz 1990, 15:354.
    """

    pressure: float = parameter(
        600.0,
        unit="Pa",
        symbol="a",
        meaning="pressure of the pericardium at its reference volume",
        sd=0.5,
        off=0.0,
        scale=600.0,
    )
    volume: float = parameter(150e-6, unit="m^3", symbol="V_0", meaning="reference volume of a ventricle")
    growth: float = parameter(
        25e-6, unit="m^3", symbol="v", meaning="volume over which its pressure grows e-fold", sd=0.3, low=5e-6
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(rise=self.pressure, volume=self.volume, scale=self.growth)
