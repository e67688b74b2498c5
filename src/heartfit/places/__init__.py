"""Places: slots of the heart's equations in which a free function of time may act.

A discrepancy beside the measured curves says that something is missing; a function inside the equations says where,
conserves blood, and can be carried to another state of the same heart. A place is a mechanism of one role with such a
function instead of a law. Source: latent force models, Alvarez, Luengo and Lawrence 2013, doi:10.1109/TPAMI.2013.86.
"""

from heartfit.places.aortic_pressure import AorticPressure
from heartfit.places.atrial_pressure import AtrialPressure
from heartfit.places.periodic import COEFFICIENTS, PeriodicFunction, Place
from heartfit.places.wall_pressure import WallPressure

PLACES: tuple[type[Place], ...] = (WallPressure, AtrialPressure, AorticPressure)
"""All places."""

__all__ = [
    "COEFFICIENTS",
    "PLACES",
    "AorticPressure",
    "AtrialPressure",
    "PeriodicFunction",
    "Place",
    "WallPressure",
]
