"""Arterial reflection: the pulse that comes back from the periphery and meets the ejecting ventricle."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import bump
from heartfit.roles import Pressure, mechanism


@mechanism
@dataclass(frozen=True)
class ArterialReflection(Pressure):
    r"""A backward wave in the aorta, in addition to the pressure of the Windkessel.

    .. math:: p(t) = a \cos^2 \frac{\pi (t - t_r)}{w} \quad \text{for } |t - t_r| < \tfrac{w}{2}

    In an old, stiff aorta it arrives in late systole (:math:`t_r` some 0.2 s after the valve opened) and raises the
    pressure against which the ventricle ejects; in a young one it arrives after the valve has closed.
    Source: backward waves in Westerhof et al., Cardiovasc Res 1972, 6:648; their return times in O'Rourke and Kelly,
    J Hypertens 1993, 11:327.
    """

    compartments = ("aorta",)
    wave: float = parameter(
        1000.0, unit="Pa", symbol="a", meaning="height of the reflected wave", sd=0.5, off=0.0, scale=1000.0
    )
    arrival: float = parameter(
        0.42, unit="s", symbol="t_r", meaning="time of its maximum at the heart", scale=0.03
    )
    width: float = parameter(
        0.25, unit="s", symbol="w", meaning="length of the wave, foot to foot", sd=0.2, low=0.05
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return self.wave * bump(time, self.arrival, self.width, period)
