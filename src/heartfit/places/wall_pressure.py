"""A pressure on the wall of the left ventricle."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfTime
from heartfit.roles import External
from heartfit.roles.laws import Load


@dataclass(frozen=True)
class WallPressure(FunctionOfTime, External):
    """Pressure [Pa] added to that of the left ventricle at a given volume: by muscle, wall or what lies around it."""

    region = "wall"
    slot = "the pressure on the wall of the left ventricle"
    unit = "Pa"
    amplitude = 6000.0

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(pulse=self.function.at(time)) if ventricle == "lv" else Load()
