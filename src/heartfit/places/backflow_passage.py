"""A passage from the aorta into the left ventricle."""

from dataclasses import dataclass

from heartfit.places.passage import Passage


@dataclass(frozen=True)
class BackflowPassage(Passage):
    """From the aorta into the left ventricle, while the aortic pressure is the higher one."""

    region = "backflow"
    slot = "a flow from the aorta into the left ventricle, driven by their pressures"
    upstream = "aorta"
    downstream = "lv"
