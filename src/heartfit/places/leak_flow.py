"""A flow out of the left ventricle, free in time."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfTime
from heartfit.roles import Flow
from heartfit.roles.laws import Branch


@dataclass(frozen=True)
class LeakFlow(FunctionOfTime, Flow):
    """Flow [m^3/s] from the left ventricle into the left atrium: a prescribed pressure does not tell where it goes."""

    region = "leak"
    slot = "a flow out of the left ventricle; where it goes is not seen"
    unit = "m^3/s"
    amplitude = 60e-6
    upstream = "lv"
    downstream = "left_atrium"

    def law(self, time: Floats) -> Branch:
        return Branch(source=self.function.at(time))
