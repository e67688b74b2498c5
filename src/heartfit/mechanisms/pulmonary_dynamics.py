"""Pulmonary valve dynamics: inertia of the blood in the valve, and leaflets that take time to open and to close."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ValveDynamics, mechanism


@mechanism
@dataclass(frozen=True)
class PulmonaryDynamics(ValveDynamics):
    """Inertance and leaflets of the pulmonary valve; equations in ``ValveDynamics``.

    The area gives the peak speed of 0.75 m/s that Doppler ultrasound measures (Hatle and Angelsen, Doppler Ultrasound
    in Cardiology, 1985) to a flow of 400 mL/s. The length is that of a thin opening of this area, pi a / 2 with its
    radius a (Rayleigh, The Theory of Sound, section 306), 21 mm, and 2 mm of leaflets. The rates, of the order of
    those of Mynard's model, are a choice. It declares no scale: a left ventricle hardly shows it.
    """

    valve = "pulmonary"
    slowness: float = redeclared(ValveDynamics, "slowness", 1.0, symbol="s_{pu}")
    length: float = redeclared(ValveDynamics, "length", 0.023, symbol="l_{pu}")
    area: float = redeclared(ValveDynamics, "area", 5.3e-4, symbol="A_{pu}")
    opening: float = redeclared(ValveDynamics, "opening", 0.2, symbol="K_{o,pu}")
    closing: float = redeclared(ValveDynamics, "closing", 0.2, symbol="K_{c,pu}")
