"""Exponential stiffening: a wall whose stiffness grows exponentially with its stretch."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Stress, mechanism


@mechanism
@dataclass(frozen=True)
class ExponentialStiffening(Stress):
    r"""Isotropic energy whose stiffness vanishes at rest and grows exponentially.

    .. math:: W = \frac{a}{2 b} \big( e^{b x} - 1 - b x \big), \qquad x = \bar I_1 - 3,

    as of collagen, which bears load once its crimp is straightened; fibrosis raises a. A wall that thickens strains an
    isotropic law more than one that fills, so it impairs the ejection too; one that acts in filling only is
    :class:`~heartfit.mechanisms.fibre_stiffening.FibreStiffening`.
    Sources: Fung, Biomechanics: Mechanical Properties of Living Tissues, 1993; Demiray, J Biomech 1972, 5:309, whose
    law it is, less the linear term.
    """

    acts_on = "wall"
    modulus: float = parameter(
        2.5e3, unit="Pa", symbol="a", meaning="scale of the exponential energy", off=0.0, scale=2.5e3
    )
    exponent: float = parameter(2.0, unit="1", symbol="b", meaning="exponent of the energy", sd=0.3, low=1e-3)

    def __post_init__(self) -> None:
        require_admissible(self)

    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        half = 0.5 * self.modulus
        return half * np.expm1(self.exponent * x), half * self.exponent * np.exp(self.exponent * x)
