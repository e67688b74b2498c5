"""Fibre stiffening: fibres that resist their stretch exponentially."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Stress, mechanism


@mechanism
@dataclass(frozen=True)
class FibreStiffening(Stress):
    r"""Fibres that are straightened over the first strain and then resist exponentially.

    .. math:: \frac{dW}{dx} = a\, x\, \frac{x}{x + \delta}\, e^{b x^2}, \qquad x = \max(\bar I_{4f} - 1, 0),

    as of titin in its stiffer isoform and the collagen along the muscle cells; shortened fibres buckle. In healthy
    walls a is some 20 kPa, which the isotropic law in the slot of the tissue spreads over all directions.
    Source: the fibre term of Holzapfel and Ogden, Phil Trans R Soc A 2009, 367:3445; the recruitment over
    :math:`\delta`, without which the stiffness would jump at rest, is ours.
    """

    acts_on = "fibre"
    modulus: float = parameter(
        1e4, unit="Pa", symbol="a_f", meaning="scale of the fibres' energy", off=0.0, scale=1e4
    )
    exponent: float = parameter(
        8.0, unit="1", symbol="b_f", meaning="exponent of the fibres' energy", sd=0.3, low=1e-3
    )
    crimp: float = parameter(
        0.05, unit="1", symbol=r"\delta", meaning="strain over which the fibres are straightened", low=1e-4
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        x = np.maximum(x, 0.0)
        straight, growth = x / (x + self.crimp), self.modulus * np.exp(self.exponent * x**2)
        rate = 1.0 + self.crimp / (x + self.crimp) + 2.0 * self.exponent * x**2
        return growth * x * straight, growth * straight * rate
