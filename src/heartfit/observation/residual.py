r"""Residuals of a simulated beat against a measured one: of curves, in units of noise, and of segmental strain.

.. math:: r(t) = \frac{y^{simulated}(t) - y^{measured}(t)}{\sqrt{\sigma^2(t) + \rho^2}}

:math:`\sigma` is the standard deviation that the noise model of the images gives the volume in this phase, after its
bias was removed; without a model it is estimated from the upper half of the spectrum of the curve. :math:`\rho` is the
roughness of any simulation against a real heart (0.6 mL, 0.15 kPa). A positive residual means that the simulation is
too large.

Residuals of neighbouring samples are correlated, and one unscented step without noise leaves residuals of ten units in
a model of the right structure: a residual alone is no evidence of missing physics.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.beat import PHASES, BeatPhases
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import frame_noise
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.shape import cavity_volumes
from heartfit.observation.strain import segment_strain

SIMULATION_ROUGHNESS = {"volume": 0.6e-6, "pressure": 150.0}
"""Deviation of any simulation from a real heart: volume [m^3] and pressure [Pa]."""
MEASURED_CURVES = ("lv_volume", "rv_volume", "lv_pressure", "aorta_pressure")
MIN_SAMPLES = 2
"""Fewest samples in a phase of the beat for which a mean residual is reported."""


@dataclass(frozen=True, eq=False)
class StrainResidual:
    """Simulated minus measured strain (3, 16), along DIRECTIONS in SEGMENTS, at ``time`` [s] after the trigger.

    noise (3, 16): standard deviation of the registration error; None where it is unknown.
    """

    time: float
    difference: Floats
    noise: Floats | None

    def score(self) -> Floats:
        """Difference in units of noise, or in percent of length without noise."""
        score: Floats = self.difference / (0.01 if self.noise is None else self.noise)
        return score


def strain_residual(
    mesh: VentricularMesh, measured: Motion, simulated: Motion | None, models: Sequence[NoiseModel]
) -> StrainResidual | None:
    """Strain residual at end systole of the measured left ventricle; both motions at the same frames.

    simulated: None for a failed beat, which has no residual; models: noise of the images, or empty; the bias of
    its strain corrects the residual, and its deviation is the noise.
    """
    if simulated is None:
        return None
    phase = int(cavity_volumes(mesh, measured)["lv_volume"].values.argmin())
    difference = (segment_strain(mesh, simulated) - segment_strain(mesh, measured))[phase]
    for error in (model.strain for model in models if model.strain is not None):
        return StrainResidual(float(measured.times[phase]), difference + error.bias, error.sd)
    return StrainResidual(float(measured.times[phase]), difference, None)


@dataclass(frozen=True, eq=False)
class Residual:
    """Residual of one curve (k,) [SI]: times, measured without bias, noise, and simulated by the label of the beat."""

    curve: str
    times: Floats
    measured: Floats
    noise: Floats
    simulated: Mapping[str, Floats]

    def difference(self, label: str) -> Floats:
        """Simulated minus measured values (k,) [SI]."""
        return self.simulated[label] - self.measured

    def score(self, label: str) -> Floats:
        """Difference (k,) in units of noise."""
        score: Floats = self.difference(label) / self.noise
        return score


@dataclass(frozen=True)
class Misfit:
    """Mean difference [SI] and mean score of a curve over a phase of the beat."""

    curve: str
    phase: str
    difference: float
    score: float


@dataclass(frozen=True, eq=False)
class CaseResidual:
    """Residuals of one case: of curves, with the phases of the last completed beat, and of its strain.

    Without a completed beat there are no curves and no phases.
    """

    curves: Sequence[Residual]
    phases: BeatPhases | None
    strain: StrainResidual | None

    @property
    def label(self) -> str:
        """Label of the last beat."""
        return list(self.curves[0].simulated)[-1]

    def misfits(self) -> list[Misfit]:
        """Misfits of the last beat, the largest score first."""
        return [] if self.phases is None else misfits(self.curves, self.phases, self.label)


def case_residual(
    measured: Mapping[str, Curve],
    simulated: Mapping[str, Mapping[str, Curve]],
    models: Sequence[NoiseModel],
    strain: StrainResidual | None = None,
) -> CaseResidual:
    """Residual of a case; simulated: curves by label of the beat, empty for a failed one; strain: of the last beat."""
    completed = [curves for curves in simulated.values() if curves]
    if not completed:
        return CaseResidual((), None, None)
    curves = residuals(measured, simulated, models)
    return CaseResidual(curves, BeatPhases.from_curves(completed[-1]), strain)


def residuals(
    measured: Mapping[str, Curve], simulated: Mapping[str, Mapping[str, Curve]], models: Sequence[NoiseModel]
) -> list[Residual]:
    """Residual of each measured curve against the beats, time zero at the trigger; failed beats are left out.

    models: the noise model of the images, or empty.
    """
    beats = {label: curves for label, curves in simulated.items() if curves}
    results = []
    for name in MEASURED_CURVES:
        if name in measured:
            curve, noise = unbiased_with_noise(name, measured[name], models)
            values = {label: curves[name](curve.times) for label, curves in beats.items()}
            results.append(Residual(name, curve.times, curve.values, noise, values))
    return results


def unbiased_with_noise(name: str, curve: Curve, models: Sequence[NoiseModel]) -> tuple[Curve, Floats]:
    """Return the curve without bias and the standard deviation (k,) [SI] of its residual under a correct simulation."""
    kind = name.rsplit("_", 1)[1]
    for model in models if kind == "volume" else ():
        frames, variance = model.corrected_curve(curve, name), np.diag(model.curve_covariance(curve, name))
        return frames, np.sqrt(variance + SIMULATION_ROUGHNESS[kind] ** 2)
    return curve, np.full(curve.times.size, np.hypot(frame_noise(curve), SIMULATION_ROUGHNESS[kind]))


def misfits(curves: Sequence[Residual], phases: BeatPhases, label: str) -> list[Misfit]:
    """Mean residual of each curve in each phase with MIN_SAMPLES or more samples, the largest score first."""
    means = [
        Misfit(
            residual.curve,
            phase,
            float(residual.difference(label)[inside].mean()),
            float(residual.score(label)[inside].mean()),
        )
        for residual in curves
        for phase in PHASES
        if (inside := np.array([name == phase for name in phases.names_at(residual.times)])).sum()
        >= MIN_SAMPLES
    ]
    return sorted(means, key=lambda misfit: -abs(misfit.score))
