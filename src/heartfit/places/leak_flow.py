"""A flow out of the left ventricle, free in time."""

from dataclasses import dataclass

from heartfit.places.place import AddedFlow


@dataclass(frozen=True)
class LeakFlow(AddedFlow):
    """Flow [m^3/s] from the left ventricle into the left atrium: a prescribed pressure does not tell where it goes."""

    region = "leak"
    slot = "a flow out of the left ventricle; where it goes is not seen"
    upstream = "lv"
    downstream = "left_atrium"
