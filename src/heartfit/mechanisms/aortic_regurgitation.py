"""Aortic regurgitation: a leak of the closed aortic valve in diastole."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Regurgitation, mechanism


@mechanism
@dataclass(frozen=True)
class AorticRegurgitation(Regurgitation):
    """Backward flow through the orifice that the aortic valve leaves open; equations in ``Regurgitation``.

    The drop lasts for all of diastole, so areas are smaller than those of the mitral valve: regurgitation is mild below
    0.1 cm^2 and severe from 0.3 cm^2; two scales are the middle of moderate.
    """

    upstream = "aorta"
    downstream = "lv"
    area: float = redeclared(Regurgitation, "area", 0.1e-4, scale=0.1e-4)
