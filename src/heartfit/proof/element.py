r"""Is it the patient or the simulator? What a locking-free heart shows, and who explains it.

A heart is hidden that is the calibrator's own but for a finer mesh of another element. Rivals are fitted to half of its
volume and pressure: the calibrator as it is, the same with the other element, the same with a mechanism. They share
data, noise and priors, so that

.. math:: \ln B = \ln Z_{rival} - \ln Z_{none}

says which one lacked what; what no fit has seen says what that gains.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from heartfit.cohort.generate import generate
from heartfit.cohort.protocol import Protocol
from heartfit.cohort.template import Template
from heartfit.configuration.generator import Pressures
from heartfit.configuration.numerics import TimeScheme
from heartfit.configuration.setting import Element, Setting
from heartfit.diagnosis.rivals import Rival
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.observation.beat import beat_curves
from heartfit.planting.measuring import Study, measured
from heartfit.proof.extension import Extension
from heartfit.proof.model import Model
from heartfit.proof.proof import curve_gains
from heartfit.proof.reference import activated
from heartfit.proof.refit import refit
from heartfit.proof.split import Target
from heartfit.proof.target import MeasuredCase

MEASURING = Study(frames=25, noise=0.01)


def hidden_case(
    fine: VentricularMesh,
    template: Template,
    heart: Heart,
    pressures: Pressures,
    scheme: TimeScheme,
    seed: int,
) -> tuple[MeasuredCase, VentricularMesh]:
    """What a heart on a fine mesh shows, with the errors of the hidden spheres, and the calibrator's mesh of its wall.

    fine: of another template, the wall under the pressures of end diastole.
    """
    protocol = Protocol(scheme.numerics(), (pressures.lv, pressures.rv))
    hidden = generate(fine, (heart, {}), protocol)
    curves = measured(hidden.beat, (), MEASURING, np.random.default_rng(seed))
    return MeasuredCase.of(curves, []), activated(template.refilling(hidden.mesh, fine))


def rivals_of(setting: Setting, element: Element, mechanism: str) -> dict[str, Extension]:
    """The calibrator as it is, with the other element, and with a mechanism."""
    as_it_is = Extension(setting)
    return {
        f"{setting.element} as it is": as_it_is,
        f"{element} in place of {setting.element}": replace(as_it_is, element=element),
        f"{setting.element} with {mechanism}": Extension.by(setting, mechanism),
    }


def contest(
    case: MeasuredCase, model: Model, extensions: Mapping[str, Extension], most: int
) -> tuple[Rival, ...]:
    """Every extension refitted in at most so many steps, the first of which is none.

    Raises CalibrationError where a refit fails.
    """
    none, *others = (_refitted(name, each, model, case.target, most) for name, each in extensions.items())
    gained = [replace(each, gains=tuple(curve_gains(case, none.curves, each.curves))) for each in others]
    return (none, *gained)


def _refitted(name: str, extension: Extension, model: Model, target: Target, most: int) -> Rival:
    fitted = refit(extension, model, target, most)
    curves = beat_curves(model(extension, fitted.parameters))
    told = fitted.log_evidence, fitted.misfit, fitted.samples, fitted.simulations
    return Rival(name, *told, fitted.parameters, curves)
