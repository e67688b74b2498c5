"""Mitral regurgitation: a leak of the closed mitral valve in systole."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Regurgitation, mechanism


@mechanism
@dataclass(frozen=True)
class MitralRegurgitation(Regurgitation):
    """Backward flow through the orifice that the mitral valve leaves open; equations in ``Regurgitation``.

    Severe regurgitation starts at A = 0.4 cm^2.
    """

    upstream = "lv"
    downstream = "left_atrium"
    area: float = redeclared(Regurgitation, "area", 0.2e-4, scale=0.15e-4)
