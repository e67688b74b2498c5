"""A passage out of the left ventricle."""

from dataclasses import dataclass

from heartfit.places.passage import Passage


@dataclass(frozen=True)
class LeakPassage(Passage):
    """From the left ventricle into the left atrium: a prescribed pressure does not tell where the flow goes."""

    region = "leak"
    slot = "a flow out of the left ventricle, driven by its pressure; where it goes is not seen"
    upstream = "lv"
    downstream = "left_atrium"
