"""What a simulated motion leaves of the measured strain at end systole, segment by segment."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.comparison import Comparison
from heartfit.observation.strain import segment_strain
from heartfit.observation.volumes import cavity_volumes


@dataclass(frozen=True, eq=False)
class StrainResidual:
    """Simulated less measured strain (3, 16), along DIRECTIONS in SEGMENTS, at time s after the trigger.

    noise (3, 16): what registration is known to add; None where nobody has measured it.
    """

    time: float
    difference: Floats
    noise: Floats | None

    def score(self) -> Floats:
        """The difference in units of noise, or in percent of length where no noise is known."""
        score: Floats = self.difference / (0.01 if self.noise is None else self.noise)
        return score


def strain_residual(
    mesh: VentricularMesh, measured: Motion, simulated: Motion | None, known: Sequence[Comparison]
) -> StrainResidual | None:
    """The residual where the measured left ventricle is smallest; both motions at the same frames.

    simulated: None of a failed beat, which leaves nothing to compare; known: sequences of known truth, whose mean error
    is taken off and whose scatter is the noise; none if empty.
    """
    if simulated is None:
        return None
    phase = int(cavity_volumes(mesh, measured)["lv_volume"].values.argmin())
    difference = (segment_strain(mesh, simulated) - segment_strain(mesh, measured))[phase]
    if not known:
        return StrainResidual(float(measured.times[phase]), difference, None)
    errors = np.array([each.strain_error_at_end_systole() for each in known])
    return StrainResidual(
        float(measured.times[phase]), difference + errors.mean(axis=0), errors.std(axis=0, ddof=1)
    )
