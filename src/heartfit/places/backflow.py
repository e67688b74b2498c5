"""A flow between aorta and left ventricle, free in time."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfTime
from heartfit.roles import Flow
from heartfit.roles.laws import Branch


@dataclass(frozen=True)
class Backflow(FunctionOfTime, Flow):
    """Flow [m^3/s] from the aorta into the left ventricle, past the valve."""

    region = "backflow"
    slot = "a flow from the aorta into the left ventricle"
    unit = "m^3/s"
    amplitude = 60e-6
    upstream = "aorta"
    downstream = "lv"

    def law(self, time: Floats) -> Branch:
        return Branch(source=self.function.at(time))
