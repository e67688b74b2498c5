"""Tricuspid regurgitation: a leak of the closed tricuspid valve in systole."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Regurgitation, mechanism


@mechanism
@dataclass(frozen=True)
class TricuspidRegurgitation(Regurgitation):
    """Backward flow through the orifice that the tricuspid valve leaves open; equations in ``Regurgitation``.

    The right ventricle drives it with a fifth of the left one's pressure, so areas are
    larger than those of the mitral valve: severe regurgitation starts at A = 0.4 cm^2, two scales.
    """

    upstream = "rv"
    downstream = "right_atrium"
    area: float = redeclared(Regurgitation, "area", 0.2e-4, scale=0.2e-4)
