"""Losses of pressure in a valve, by the square of its flow."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import Place
from heartfit.roles import Narrowing


@dataclass(frozen=True)
class ValveLoss(Place, Narrowing):
    r"""Loss :math:`\tfrac12 \rho a q^2`, a >= 0 [1/m^4]."""

    loss: float
    unit = "1/m^4"
    size = 1
    one_sided = True

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:  # noqa: ARG003
        if np.any(z < 0.0):
            raise ValueError(f"valve loss: coefficient {z}; expected none that is negative")
        return cls(cls.amplitude * float(z[0]))

    def sizes(self) -> Mapping[str, float]:
        return {"loss": self.loss}

    def inverse_square(self) -> float:
        return self.loss
