"""Fibre stiffening: fibres that resist their stretch exponentially."""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Stress, mechanism
from heartfit.parameter import parameter, require_admissible


@mechanism
@dataclass(frozen=True)
class FibreStiffening(Stress):
    r"""Energy of stretched fibres.

    .. math:: W = \frac{a}{3 b} \big( e^{b x^3} - 1 \big), \qquad x = \max(\bar I_{4f} - 1, 0),

    titin in its stiffer isoform and the collagen along the muscle cells; shortened fibres buckle.
    Source: the fibre term of Holzapfel and Ogden, Phil Trans R Soc A 2009, 367:3445, with the cube of x for its square:
    the stiffness then sets in without a jump.
    """

    of = "fibre"
    modulus: float = parameter(
        3e4, unit="Pa", symbol="a_f", meaning="scale of the fibres' energy", off=0.0, scale=3e4
    )
    exponent: float = parameter(
        8.0, unit="1", symbol="b_f", meaning="exponent of the fibres' energy", sd=0.3, low=1e-3
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        stretched = np.maximum(x, 0.0)
        growth = self.modulus * np.exp(self.exponent * stretched**3)
        return growth * stretched**2, growth * (2.0 * stretched + 3.0 * self.exponent * stretched**4)
