"""All places, one a row: its name, its form, the region, its slot in words, and the constants of its form."""

from typing import TypeVar

from heartfit.places.circuit import AddedFlow, AddedPressure, Passage, ValveLoss
from heartfit.places.place import FunctionOfTime, Place, Region
from heartfit.places.sensor import ErrorInTime, ErrorInValue, ErrorOfClock, ErrorWhileHigh
from heartfit.places.wall import ActivationDelay, AttachmentRate, DetachmentRate, WallElasticity, WallPressure

P = TypeVar("P", bound=Place)


def place(name: str, form: type[P], region: Region, slot: str, **constants: object) -> type[P]:
    """Return the place of this ``name``, a class of the form that states where it acts and its prior."""
    return type(name, (form,), {"region": region, "slot": slot, "__module__": __name__, **constants})


OUT, BACK = {"upstream": "lv", "downstream": "left_atrium"}, {"upstream": "aorta", "downstream": "lv"}
"""Ends of a flow out of the left ventricle, and of one back into it."""
VOLUME = {"measures": ("lv_volume",), "unit": "m^3", "amplitude": 10e-6}
PRESSURE = {"measures": ("lv_pressure",), "unit": "Pa", "amplitude": 1500.0}
"""Curve of an instrument, and its errors."""

# fmt: off
PLACES: tuple[type[Place], ...] = (
    AtrialPressure := place("AtrialPressure", AddedPressure, "filling",
        "the pressure of the left atrium, less a loss in the mitral valve",
        compartments=("left_atrium",), amplitude=1000.0),
    MitralLoss := place("MitralLoss", ValveLoss, "filling", "a loss of pressure in the mitral valve", valve="mitral"),
    AorticPressure := place("AorticPressure", AddedPressure, "ejection",
        "the pressure of the aorta, or a loss in the aortic valve", compartments=("aorta",), amplitude=3000.0),
    AorticLoss := place("AorticLoss", ValveLoss, "ejection", "a loss of pressure in the aortic valve", valve="aortic"),
    LeakFlow := place("LeakFlow", AddedFlow, "leak",
        "a flow out of the left ventricle; where it goes is not seen", **OUT),
    LeakPassage := place("LeakPassage", Passage, "leak",
        "a flow out of the left ventricle, driven by its pressure; where it goes is not seen", **OUT),
    Backflow := place("Backflow", AddedFlow, "backflow", "a flow from the aorta into the left ventricle", **BACK),
    BackflowPassage := place("BackflowPassage", Passage, "backflow",
        "a flow from the aorta into the left ventricle, driven by their pressures", **BACK),
    WallPressure, WallElasticity, AttachmentRate, DetachmentRate, ActivationDelay,
    VolumeError := place("VolumeError", ErrorInTime, "images", "the measured volume, at a time", **VOLUME),
    VolumeScale := place("VolumeScale", ErrorInValue, "images", "the measured volume, at a value", **VOLUME),
    VolumeClock := place("VolumeClock", ErrorOfClock, "images",
        "the times of the measured volume", measures=("lv_volume",)),
    PressureError := place("PressureError", ErrorInTime, "catheter", "the measured pressure, at a time", **PRESSURE),
    SystolicPressureError := place("SystolicPressureError", ErrorWhileHigh, "catheter",
        "the measured pressure in systole", **PRESSURE | {"amplitude": 2000.0}),
    PressureScale := place("PressureScale", ErrorInValue, "catheter", "the measured pressure, at a value", **PRESSURE),
    PressureClock := place("PressureClock", ErrorOfClock, "catheter",
        "the times of the measured pressure", measures=("lv_pressure",)),
)
# fmt: on
"""Volumes do not tell a pressure of the atrium from a loss in its valve, nor a set pressure where a leak goes."""

EARLIER_PLACES: tuple[type[FunctionOfTime], ...] = (WallPressure, AtrialPressure, AorticPressure)
"""Places whose functions take up what the equations lack of an earlier recording of a heart."""
