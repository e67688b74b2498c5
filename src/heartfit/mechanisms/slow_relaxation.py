"""Slow relaxation: a tail of the tension after its fast fall."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Relaxation, mechanism


@mechanism
@dataclass(frozen=True)
class SlowRelaxation(Relaxation):
    r"""Relaxation whose time constant grows from that of k_RS to 1 + a times as much.

    .. math:: |u|(t) = k_{RS} \Big[ 1 - \frac{a}{1 + a} \big(1 - e^{-t / T}\big) \Big]

    at the time t after repolarisation: calcium leaves the cytosol slowly once its pumps are short of energy, and the
    pressure falls with two time constants, the second one longer in coronary disease.
    Sources: two time constants in Rousseau et al., Circulation 1980, 62:764; relaxation and its time constant in
    diastolic failure in Zile and Gaasch, Prog Cardiovasc Dis 1990, 32:351. The exponential transition is ours.
    """

    slowing: float = parameter(
        0.6, unit="1", symbol="a", meaning="late over early time constant, less 1", off=0.0, scale=0.6
    )
    transition: float = parameter(
        0.04, unit="s", symbol="T", meaning="time of the transition", sd=0.4, low=1e-3
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def missing_integral(self, time: Floats) -> Floats:
        share = self.slowing / (1.0 + self.slowing)
        integral: Floats = share * (time + self.transition * np.expm1(-time / self.transition))
        return integral
