"""Places: slots of the heart's equations, or of its measurement, in which a free function may act.

A discrepancy beside the measured curves says that something is missing; a function inside the equations says where,
conserves blood, and can be carried to another state of the same heart. A place is a mechanism of one role with such a
function instead of a law: of time, or of the slot's own state. Source: latent force models, Alvarez, Luengo and
Lawrence 2013, doi:10.1109/TPAMI.2013.86.
"""

from heartfit.places.activation_delay import ActivationDelay
from heartfit.places.aortic_loss import AorticLoss
from heartfit.places.aortic_pressure import AorticPressure
from heartfit.places.atrial_pressure import AtrialPressure
from heartfit.places.attachment import AttachmentRate
from heartfit.places.backflow import Backflow
from heartfit.places.backflow_passage import BackflowPassage
from heartfit.places.cosines import COSINES, CosineFunction
from heartfit.places.detachment import DetachmentRate
from heartfit.places.leak_flow import LeakFlow
from heartfit.places.leak_passage import LeakPassage
from heartfit.places.mitral_loss import MitralLoss
from heartfit.places.periodic import COEFFICIENTS, PeriodicFunction
from heartfit.places.place import REGIONS, FunctionOfState, FunctionOfTime, Place, Region
from heartfit.places.pressure_clock import PressureClock
from heartfit.places.pressure_error import PressureError
from heartfit.places.pressure_scale import PressureScale
from heartfit.places.region import regions_of
from heartfit.places.systolic_pressure_error import SystolicPressureError
from heartfit.places.volume_clock import VolumeClock
from heartfit.places.volume_error import VolumeError
from heartfit.places.volume_scale import VolumeScale
from heartfit.places.wall_elasticity import WallElasticity
from heartfit.places.wall_pressure import WallPressure

PLACES: tuple[type[Place], ...] = (
    *(AtrialPressure, MitralLoss, AorticPressure, AorticLoss),
    *(LeakFlow, LeakPassage, Backflow, BackflowPassage),
    *(WallPressure, WallElasticity, AttachmentRate, DetachmentRate, ActivationDelay),
    *(VolumeError, VolumeScale, VolumeClock),
    *(PressureError, SystolicPressureError, PressureScale, PressureClock),
)
"""All places."""

EARLIER_PLACES: tuple[type[FunctionOfTime], ...] = (WallPressure, AtrialPressure, AorticPressure)
"""Places whose functions take up what the equations lack of an earlier recording of a heart."""

__all__ = [
    "COEFFICIENTS",
    "COSINES",
    "EARLIER_PLACES",
    "PLACES",
    "REGIONS",
    "ActivationDelay",
    "AorticLoss",
    "AorticPressure",
    "AtrialPressure",
    "AttachmentRate",
    "Backflow",
    "BackflowPassage",
    "CosineFunction",
    "DetachmentRate",
    "FunctionOfState",
    "FunctionOfTime",
    "LeakFlow",
    "LeakPassage",
    "MitralLoss",
    "PeriodicFunction",
    "Place",
    "PressureClock",
    "PressureError",
    "PressureScale",
    "Region",
    "SystolicPressureError",
    "VolumeClock",
    "VolumeError",
    "VolumeScale",
    "WallElasticity",
    "WallPressure",
    "regions_of",
]
