"""How hearts are made whose truth is known."""

from pydantic import Field

from heartfit.cohort.protocol import Protocol
from heartfit.configuration.numerics import MeshSize, TimeScheme
from heartfit.configuration.strict import Strict


class Pressures(Strict):
    """Pressures of the ventricles at end diastole, under which the measured mesh stands."""

    lv: float = Field(ge=0, lt=5e3, description="Pa")
    rv: float = Field(ge=0, lt=5e3, description="Pa")


class Generator(Strict):
    """Mesh and time scheme of such hearts."""

    mesh: MeshSize
    numerics: TimeScheme

    def protocol(self, pressures: Pressures) -> Protocol:
        """As the cohort takes it."""
        return Protocol(self.numerics.numerics(), (pressures.lv, pressures.rv))
