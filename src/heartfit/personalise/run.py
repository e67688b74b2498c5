"""The steps of a calibration, each from values to values."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import Slopes
from heartfit.calibration.unscented import Outcome, SigmaPoint
from heartfit.calibration.update import Posterior, calibrate
from heartfit.core.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, failed_beat
from heartfit.heart.circulation.coupling import Body
from heartfit.heart.finite_elements.body import CHAMBERS, FiniteElementBody, StepFailed, Tissue
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.muscle.passive import require_isotropic
from heartfit.heart.simulation import Progress, simulate
from heartfit.observation.beat import beat_curves, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement, observe_measured
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import PressureFeatures, VolumeFeatures, cavity_indices, observe
from heartfit.personalise.numerics import Operator, Pressures, TimeScheme, Transform
from heartfit.personalise.setting import Setting


def ventricles(mesh: VentricularMesh, tissue: Tissue, loads: Floats, unloaded: bool = True) -> Body:
    """The ventricles that were measured as ``mesh`` under the end-diastolic pressures ``loads`` (2,), Pa.

    With ``unloaded`` their stress-free reference is found first; without, the measured state is taken as
    stress-free. The element "sphere" keeps of the mesh only its volumes.
    Raises StepFailed if there is no such reference.
    """
    if tissue.element == "sphere":
        return _spheres(mesh, tissue, loads if unloaded else np.zeros(2))
    return FiniteElementBody(unload(mesh, tissue, loads) if unloaded else mesh, tissue)


def _spheres(mesh: VentricularMesh, tissue: Tissue, loads: Floats) -> Body:
    """Spheres of the same cavities; the septum belongs to the left one."""
    from heartfit.heart.sphere.body import Sphere, SphericalBody  # finite elements need no root finder

    cavities = [Cavity.from_endocardium(mesh, f"{chamber}_endo").volume(mesh.points) for chamber in CHAMBERS]
    volumes, right = mesh.element_volumes(), np.asarray(mesh.segments) == 0
    walls = volumes[~right].sum(), volumes[right].sum()
    sides = zip(cavities, walls, loads, strict=True)
    left_sphere, right_sphere = (
        Sphere.unloaded(cavity, wall, load, require_isotropic(tissue.passive))
        if load > 0.0
        else Sphere.from_volumes(cavity, wall)
        for cavity, wall, load in sides
    )
    return SphericalBody(left_sphere, right_sphere, tissue)


OBSERVED = (*VolumeFeatures.names, *PressureFeatures.names)
"""All six observations of the paper."""


def run_beat(
    mesh: VentricularMesh,
    setting: Setting,
    period: float,
    parameters: Mapping[str, float],
    pressures: Pressures,
    scheme: TimeScheme,
    progress: Progress | None = None,
    keep_positions: bool = False,
) -> Beat:
    """The beat of a setting with some parameters changed, of ventricles that were measured at end diastole.

    The stress-free reference is found for these very parameters: a reference frozen at other passive parameters
    would change the end-diastolic volume that was measured. With the setting's reference "end_diastolic" it
    is the mesh itself.
    """
    heart = setting.base_heart(period).with_parameters(parameters)
    loads = np.array([pressures.lv, pressures.rv])
    try:
        body = ventricles(mesh, heart.muscle, loads, setting.reference == "unloaded")
    except StepFailed as failure:
        return failed_beat(str(failure), period, heart.trigger, {})
    return simulate(heart, body, replace(scheme.numerics(), keep_positions=keep_positions), progress)


def estimate(
    setting: Setting,
    prior: Gaussian,
    points: Sequence[SigmaPoint],
    beats: Iterable[Beat],
    measured: Mapping[str, Curve],
    measurement: Measurement,
    operator: Operator,
    transform: Transform,
    slopes: Slopes | None = None,
) -> Posterior:
    """The posterior from the beats of all sigma points, in their order, each seen through its own sensors.

    Without the transform's noise the numbers are met as they were measured, as the paper does; with it, those without
    bias under their covariance. Slopes add to it what the parameters that are not estimated may do.
    """
    sensors = [setting.sensors(point.parameters) for point in points]
    noise = measurement.covariance if transform.noise else None
    if noise is not None and slopes is not None:
        noise = noise + slopes.covariance(setting.estimate, measurement.corrected, transform.fixed_sd)
    observed = measurement.corrected if transform.noise else measurement.values
    outcomes = observe_beats(beats, operator.features(measured), sensors)
    return calibrate(prior, outcomes, observed, noise, transform.scaling())


def observe_plausibility(
    setting: Setting, points: Sequence[SigmaPoint], beats: Iterable[Beat], operator: Operator
) -> list[Outcome]:
    """The six observations of each beat and what else says whether it is plausible, or why it failed.

    EDV and ESV in m^3, SV in m^3 and EF as shares: not through the operator, as published values are.
    """
    features = operator.trial_features(operator.frames)
    outcomes: list[Outcome] = []
    for point, beat in zip(points, beats, strict=True):
        curves = beat_curves(beat, setting.sensors(point.parameters))
        outcomes.append(observe(curves, features) | cavity_indices(curves) if curves else beat.reason)
    return outcomes


def curves_of_points(
    setting: Setting, points: Sequence[SigmaPoint], beats: Iterable[Beat]
) -> dict[str, dict[str, Curve]]:
    """The curves of each point's beat by its label, none of a failed one."""
    return {
        point.label: beat_curves(beat, setting.sensors(point.parameters))
        for point, beat in zip(points, beats, strict=True)
    }


def observe_case(
    measured: Mapping[str, Curve],
    operator: Operator,
    models: Sequence[NoiseModel],
    protocol: Mapping[str, float | int | str | bool],
) -> Measurement:
    """Observe a case, by the noise model of its images if there is one.

    The period of synthetic images is known; a measured heart's breath-holds differ in theirs. Raises InputError for a
    model of another protocol than this.
    """
    features = operator.features(measured)
    for model in models:
        model.require_protocol(protocol)
        return observe_measured(measured, features, 0.0, model)
    return observe_measured(measured, features, operator.period_uncertainty)
