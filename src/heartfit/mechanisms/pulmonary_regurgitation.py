"""Pulmonary regurgitation: a leak of the closed pulmonary valve in diastole."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Regurgitation, mechanism


@mechanism
@dataclass(frozen=True)
class PulmonaryRegurgitation(Regurgitation):
    """Backward flow through the orifice that the pulmonary valve leaves open; equations in ``Regurgitation``.

    In the adult of the search two scales return 20 mL of a beat, a fifth of the stroke,
    and four scales 35 mL.
    """

    upstream = "pulmonary_artery"
    downstream = "rv"
    area: float = redeclared(Regurgitation, "area", 0.15e-4, scale=0.15e-4)
