"""Septal load: a right ventricle that presses on the left one in systole."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import bump
from heartfit.roles import External, mechanism
from heartfit.roles.laws import Load


@mechanism
@dataclass(frozen=True)
class SeptalLoad(External):
    r"""Part of a right ventricular pressure pulse, prescribed in time, on the outside of the left ventricle.

    .. math:: p(t) = a \cos^2 \frac{\pi (t - t_s)}{w} \quad \text{for } |t - t_s| < \tfrac{w}{2}

    A sphere has no septum: this load represents the right ventricle. Ventricles of finite elements share a septum:
    there it is the load that a right ventricle stronger than the simulated one adds. The septum transmits about a third
    of a systolic pressure of 25 mmHg, a = 1.1 kPa.
    Source: ventricular interdependence, Maughan, Sunagawa and Sagawa, Am J Physiol 1987, 253:H1381.
    """

    pressure: float = parameter(
        1000.0,
        unit="Pa",
        symbol="a",
        meaning="greatest pressure handed on by the septum",
        sd=0.5,
        off=0.0,
        scale=1000.0,
    )
    peak: float = parameter(0.36, unit="s", symbol="t_s", meaning="time of the maximum", scale=0.03)
    width: float = parameter(
        0.40, unit="s", symbol="w", meaning="length of the pulse, foot to foot", low=0.05
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def load(self, ventricle: str, time: Floats, period: float) -> Load:
        if ventricle != "lv":
            return Load()
        return Load(pulse=self.pressure * bump(time, self.peak, self.width, period))
