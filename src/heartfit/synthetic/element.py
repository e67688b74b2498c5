r"""Element error or missing mechanism: competing refits of one recording, compared by their evidence.

The hidden heart equals the calibrator's but for a finer mesh of another, locking-free element. Three models are fitted
to half of its volume and pressure: the calibrator as it is (the baseline), the calibrator with the other element, and
the calibrator with a mechanism. They share data, noise and priors, so that

.. math:: \ln B = \ln Z_{model} - \ln Z_{baseline}

compares them; the gain is measured on samples that no refit used.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.model import Model, activate
from heartfit.discovery.refit.refit import refit
from heartfit.discovery.refit.target import MeasuredCase, Target
from heartfit.discovery.refit.verdict import curve_gains
from heartfit.discovery.sphere_model.cause import Gain
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.heart import Heart
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.numerics import Pressures, Protocol, TimeScheme
from heartfit.personalise.setting import Element, Setting
from heartfit.synthetic.hidden import RecordingProtocol, measure_beat
from heartfit.synthetic.volunteer import Template, generate


@dataclass(frozen=True, eq=False)
class CompetingModel:
    """Refitted model, the curves of its beat, and its gains over the baseline on held-out samples.

    log_evidence: up to a constant of the samples; misfit: r^T R^-1 r over ``samples``; parameters: SI, by name.
    """

    name: str
    log_evidence: float
    misfit: float
    samples: int
    simulations: int
    parameters: Mapping[str, float]
    curves: Mapping[str, Curve]
    gains: tuple[Gain, ...] = ()


RECORDING = RecordingProtocol(frames=25, noise=0.01)


def hidden_case(
    fine: VentricularMesh,
    template: Template,
    heart: Heart,
    pressures: Pressures,
    scheme: TimeScheme,
    seed: int,
) -> tuple[MeasuredCase, VentricularMesh]:
    """Return the measurement of a heart on a fine mesh, and the calibrator's mesh of its wall.

    The measurement errors are those of hidden spheres. fine: mesh from another template, at end-diastolic pressure.
    """
    protocol = Protocol(scheme.numerics(), (pressures.lv, pressures.rv))
    hidden = generate(fine, (heart, {}), protocol)
    curves = measure_beat(hidden.beat, (), RECORDING, np.random.default_rng(seed))
    return MeasuredCase.from_curves(curves, []), activate(template.fill_wall_of(hidden.mesh, fine))


def competing_extensions(setting: Setting, element: Element, mechanism: str) -> dict[str, Extension]:
    """Return the competing extensions: the calibrator alone, with the other element, and with a mechanism."""
    baseline = Extension(setting)
    return {
        f"{setting.element} as it is": baseline,
        f"{element} in place of {setting.element}": replace(baseline, element=element),
        f"{setting.element} with {mechanism}": Extension.from_names(setting, mechanism),
    }


def compare_extensions(
    case: MeasuredCase, model: Model, extensions: Mapping[str, Extension], most_steps: int
) -> tuple[CompetingModel, ...]:
    """Refit every extension in at most ``most_steps`` steps; the first extension is the baseline.

    Raises CalibrationError if a refit fails.
    """
    baseline, *others = (
        _refit(name, extension, model, case.target, most_steps) for name, extension in extensions.items()
    )
    compared = [
        replace(other, gains=tuple(curve_gains(case, baseline.curves, other.curves))) for other in others
    ]
    return (baseline, *compared)


def _refit(name: str, extension: Extension, model: Model, target: Target, most_steps: int) -> CompetingModel:
    fitted = refit(extension, model, target, target, most_steps)
    curves = beat_curves(model(extension, fitted.parameters))
    scores = fitted.log_evidence, fitted.misfit, fitted.samples, fitted.simulations
    return CompetingModel(name, *scores, fitted.parameters, curves)
