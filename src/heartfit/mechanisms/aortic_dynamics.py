"""Aortic valve dynamics: inertia of the blood in the valve, and leaflets that take time to open and to close."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ValveDynamics, mechanism


@mechanism
@dataclass(frozen=True)
class AorticDynamics(ValveDynamics):
    """Inertance and leaflets of the aortic valve; equations in ``ValveDynamics``.

    Ejection rises later and ends after the pressures have crossed; the blood that flows back closes the leaflets.
    The area gives a flow of 400 mL/s the speed of 1.0 m/s, between those that Doppler ultrasound measures in the
    outflow tract and in the aorta, 0.9 and 1.35 m/s (Hatle and Angelsen, Doppler Ultrasound in Cardiology, 1985).
    The length is that of a thin opening of this area, pi a / 2 with its radius a (Rayleigh, The Theory of Sound,
    section 306), 18 mm, and 2 mm of leaflets. The rates, of the order of those of Mynard's model, are a choice.
    It declares no scale: the nominal heart of the search has an aortic inertance already.
    """

    valve = "aortic"
    slowness: float = redeclared(ValveDynamics, "slowness", 1.0, symbol="s_{ao}")
    length: float = redeclared(ValveDynamics, "length", 0.02, symbol="l_{ao}")
    area: float = redeclared(ValveDynamics, "area", 4e-4, symbol="A_{ao}")
    opening: float = redeclared(ValveDynamics, "opening", 0.2, symbol="K_{o,ao}")
    closing: float = redeclared(ValveDynamics, "closing", 0.2, symbol="K_{c,ao}")
