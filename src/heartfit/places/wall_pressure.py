"""A pressure on the wall of the left ventricle."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.periodic import Place
from heartfit.roles import External
from heartfit.roles.laws import Load


@dataclass(frozen=True)
class WallPressure(Place, External):
    """Pressure [Pa] added to that of the left ventricle at a given volume: by muscle, wall or what lies around it."""

    amplitude = 6000.0

    def load(self, ventricle: str, time: Floats, period: float) -> Load:
        return Load(pulse=self.function.at(time, period)) if ventricle == "lv" else Load()
