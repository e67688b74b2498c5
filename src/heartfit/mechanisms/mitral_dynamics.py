"""Mitral valve dynamics: inertia of the blood in the valve, and leaflets that take time to open and to close."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ValveDynamics, mechanism


@mechanism
@dataclass(frozen=True)
class MitralDynamics(ValveDynamics):
    """Inertance and leaflets of the mitral valve; equations in ``ValveDynamics``.

    Inflow starts later, continues against an adverse pressure and partly flows back before the leaflets meet: the
    volume falls again in diastasis, and the atrial kick adds to it later.
    Sources: Mynard et al., Int J Numer Meth Biomed Eng 2012, 28:626, for the law; Thomas et al., Am J Physiol 1991,
    260:H1718, for the inertance of mitral inflow.
    """

    valve = "mitral"
    slowness: float = redeclared(ValveDynamics, "slowness", 1.0, symbol="s_{mi}", scale=1.0)
    length: float = redeclared(ValveDynamics, "length", 0.036, symbol="l_{mi}")
    area: float = redeclared(ValveDynamics, "area", 4.5e-4, symbol="A_{mi}")
    opening: float = redeclared(ValveDynamics, "opening", 0.3, symbol="K_{o,mi}")
    closing: float = redeclared(ValveDynamics, "closing", 0.05, symbol="K_{c,mi}")
