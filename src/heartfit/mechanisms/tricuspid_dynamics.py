"""Tricuspid valve dynamics: inertia of the blood in the valve, and leaflets that take time to open and to close."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ValveDynamics, mechanism


@mechanism
@dataclass(frozen=True)
class TricuspidDynamics(ValveDynamics):
    """Inertance and leaflets of the tricuspid valve; equations in ``ValveDynamics``.

    The area gives the peak speed of 0.5 m/s that Doppler ultrasound measures (Hatle and Angelsen, Doppler Ultrasound
    in Cardiology, 1985) to a flow of 350 mL/s. The length, that of the mitral valve, and the rates, of the order of
    those of Mynard's model, are choices. It declares no scale: a left ventricle hardly shows it, so no search tries it.
    """

    valve = "tricuspid"
    slowness: float = redeclared(ValveDynamics, "slowness", 1.0, symbol="s_{tr}")
    length: float = redeclared(ValveDynamics, "length", 0.036, symbol="l_{tr}")
    area: float = redeclared(ValveDynamics, "area", 7e-4, symbol="A_{tr}")
    opening: float = redeclared(ValveDynamics, "opening", 0.3, symbol="K_{o,tr}")
    closing: float = redeclared(ValveDynamics, "closing", 0.3, symbol="K_{c,tr}")
