"""How finely space and time are divided."""

from pydantic import Field

from heartfit.configuration.strict import Strict
from heartfit.simulation import Numerics


class MeshSize(Strict):
    """Wished edge length and how far the boundary may leave the measured surface."""

    edge_length: float = Field(gt=1e-3, lt=0.05, description="m")
    tolerance: float = Field(gt=1e-5, lt=5e-3, description="m")


class TimeScheme(Strict):
    """Step of the beat and when the beats count as periodic."""

    time_step: float = Field(gt=1e-5, le=0.02, description="s")
    second_order: bool = Field(True, description="BDF2 and midpoints of the fibres, or backward Euler")
    max_beats: int = Field(ge=1, le=1000)
    drift: float = Field(gt=0, lt=1, description="largest relative change from beat to beat")

    def numerics(self) -> Numerics:
        """As the simulation takes it."""
        return Numerics(**self.model_dump())
