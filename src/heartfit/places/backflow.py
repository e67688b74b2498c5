"""A flow between aorta and left ventricle, free in time."""

from dataclasses import dataclass

from heartfit.places.place import AddedFlow


@dataclass(frozen=True)
class Backflow(AddedFlow):
    """Flow [m^3/s] from the aorta into the left ventricle, past the valve."""

    region = "backflow"
    slot = "a flow from the aorta into the left ventricle"
    upstream = "aorta"
    downstream = "lv"
