r"""What a simulated beat leaves of a measured one, in units of the measurement's noise.

.. math:: r(t) = \frac{y^{simulated}(t) - y^{measured}(t)}{\sqrt{\sigma^2(t) + \rho^2}}

:math:`\sigma` is the deviation that the noise model of the images gives the volume in this phase, after its bias was
taken off, or without a model what the upper half of the curve's own spectrum holds; :math:`\rho` is the roughness that
any model of a heart has beside a real one (0.6 mL, 0.15 kPa). Positive: the simulation is too large.

Residuals of neighbouring samples are correlated, and one unscented step without noise leaves such of ten units in a
model whose structure is right: a residual by itself is no evidence of missing physics.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.observation.beat_phases import PHASES, BeatPhases
from heartfit.observation.curve import Curve
from heartfit.observation.noise import frame_noise
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.strain_residual import StrainResidual

ROUGHNESS = {"volume": 0.6e-6, "pressure": 150.0}
"""m^3 and Pa."""
MEASURED = ("lv_volume", "rv_volume", "lv_pressure", "aorta_pressure")
FEWEST = 2
"""Samples in a phase of the beat that are needed to speak of it."""


@dataclass(frozen=True, eq=False)
class Residual:
    """One curve: times (k,), measured without bias (k,) and noise (k,), SI, and simulated (k,) by the beat's label."""

    curve: str
    times: Floats
    measured: Floats
    noise: Floats
    simulated: Mapping[str, Floats]

    def difference(self, label: str) -> Floats:
        """Simulated less measured (k,), SI."""
        return self.simulated[label] - self.measured

    def score(self, label: str) -> Floats:
        """The same in units of noise."""
        score: Floats = self.difference(label) / self.noise
        return score


@dataclass(frozen=True)
class Misfit:
    """Mean over a phase of the beat: of the difference, SI, and of the score."""

    curve: str
    phase: str
    difference: float
    score: float


@dataclass(frozen=True, eq=False)
class CaseResidual:
    """All that beats leave of one case: curves, the phases of the last beat that did not fail, and its strain.

    Without such a beat there are no curves and no phases.
    """

    curves: Sequence[Residual]
    phases: BeatPhases | None
    strain: StrainResidual | None

    @property
    def label(self) -> str:
        """That of the last beat."""
        return list(self.curves[0].simulated)[-1]

    def misfits(self) -> list[Misfit]:
        """Those of the last beat, the worst first."""
        return [] if self.phases is None else misfits(self.curves, self.phases, self.label)


def case_residual(
    measured: Mapping[str, Curve],
    simulated: Mapping[str, Mapping[str, Curve]],
    models: Sequence[NoiseModel],
    strain: StrainResidual | None = None,
) -> CaseResidual:
    """What beats leave of a case; simulated: their curves by label, none of a failed one; strain: of the last."""
    beating = [curves for curves in simulated.values() if curves]
    if not beating:
        return CaseResidual((), None, None)
    found = residuals(measured, simulated, models)
    return CaseResidual(found, BeatPhases.of(beating[-1]), strain)


def residuals(
    measured: Mapping[str, Curve], simulated: Mapping[str, Mapping[str, Curve]], models: Sequence[NoiseModel]
) -> list[Residual]:
    """The residual of each measured curve against the beats, time zero at the trigger; a failed beat is left out.

    models: the noise model of the images, or none. It was learnt of left ventricles; the right one's volume is taken to
    err as much over its own stroke volume.
    """
    beats = {label: curves for label, curves in simulated.items() if curves}
    found = []
    for name in MEASURED:
        if name in measured:
            curve, noise = with_noise(name, measured[name], models)
            values = {label: curves[name](curve.times) for label, curves in beats.items()}
            found.append(Residual(name, curve.times, curve.values, noise, values))
    return found


def with_noise(name: str, curve: Curve, models: Sequence[NoiseModel]) -> tuple[Curve, Floats]:
    """The curve without bias and the standard deviation (k,) of what a right simulation leaves of it, SI."""
    kind = name.rsplit("_", 1)[1]
    for model in models if kind == "volume" else ():
        frames, variance = model.corrected_curve(curve), np.diag(model.curve_covariance(curve))
        return frames, np.sqrt(variance + ROUGHNESS[kind] ** 2)
    return curve, np.full(curve.times.size, np.hypot(frame_noise(curve), ROUGHNESS[kind]))


def misfits(found: Sequence[Residual], phases: BeatPhases, label: str) -> list[Misfit]:
    """Mean residual of each curve in each phase of the beat that has samples enough, the worst first."""
    means = [
        Misfit(
            each.curve,
            phase,
            float(each.difference(label)[inside].mean()),
            float(each.score(label)[inside].mean()),
        )
        for each in found
        for phase in PHASES
        if (inside := np.array([name == phase for name in phases.at(each.times)])).sum() >= FEWEST
    ]
    return sorted(means, key=lambda misfit: -abs(misfit.score))
