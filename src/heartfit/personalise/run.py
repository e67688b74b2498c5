"""Steps of a calibration as functions of values: body, beat, estimate, observations."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import Slopes
from heartfit.calibration.unscented import Outcome, SigmaPoint
from heartfit.calibration.update import Posterior, calibrate, narrowed
from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, failed_beat
from heartfit.heart.circulation.coupling import Body
from heartfit.heart.finite_elements.body import CHAMBERS, FiniteElementBody, StepFailed, Tissue
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.muscle.passive import require_isotropic
from heartfit.heart.neighbourhood import LoadedHeart, surround
from heartfit.heart.simulation import Progress, simulate
from heartfit.heart.tangent import differentiate, tangent_numerics
from heartfit.observation.beat import beat_curves, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement, observe_measured
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import (
    PressureFeatures,
    RightVolumeFeatures,
    VolumeFeatures,
    cavity_indices,
    observe,
)
from heartfit.personalise.numerics import Operator, Pressures, TimeScheme, Transform
from heartfit.personalise.setting import Setting


def ventricles(mesh: VentricularMesh, tissue: Tissue, loads: Floats, unloaded: bool = True) -> Body:
    """Return the ventricles measured as ``mesh`` under the end-diastolic pressures ``loads`` (2,) [Pa].

    With ``unloaded`` their stress-free reference is computed first; otherwise the measured state is assumed to be
    stress-free. The element "sphere" uses only the volumes of the mesh.
    Raises StepFailed without a stress-free reference.
    """
    if tissue.element == "sphere":
        return _spheres(mesh, tissue, loads if unloaded else np.zeros(2))
    return FiniteElementBody(unload(mesh, tissue, loads) if unloaded else mesh, tissue)


def _spheres(mesh: VentricularMesh, tissue: Tissue, loads: Floats) -> Body:
    """Return spheres with the same cavity volumes; the septum belongs to the left one."""
    from heartfit.heart.sphere.body import (
        Sphere,
        SphericalBody,
        wall_stiffenings,
    )  # only spheres need the root finder

    cavities = [Cavity.from_endocardium(mesh, f"{chamber}_endo").volume(mesh.points) for chamber in CHAMBERS]
    volumes, right = mesh.element_volumes(), np.asarray(mesh.segments) == 0
    walls = volumes[~right].sum(), volumes[right].sum()
    passive = require_isotropic(tissue.passive)
    sides = zip(cavities, walls, loads, wall_stiffenings(tissue, 2), strict=True)
    left_sphere, right_sphere = (
        Sphere.unloaded(cavity, wall, load, passive, scale)
        if load > 0.0
        else Sphere.from_volumes(cavity, wall)
        for cavity, wall, load, scale in sides
    )
    return SphericalBody(left_sphere, right_sphere, tissue)


OBSERVED = (*VolumeFeatures.names, *PressureFeatures.names)
"""All six observations of the paper."""
OBSERVED_RIGHT = RightVolumeFeatures.names
"""Observations of the right ventricle."""


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
    """Return the beat of a setting with changed parameters, for ventricles that were measured at end diastole.

    The stress-free reference is computed for these parameters: a reference for other passive parameters would change
    the measured end-diastolic volume. For the setting's reference "end_diastolic" it is the mesh.
    """
    heart = setting.base_heart(period).with_parameters(parameters)
    loads = np.array([pressures.lv, pressures.rv])
    try:
        body = ventricles(mesh, heart.muscle, loads, setting.reference == "unloaded")
    except StepFailed as failure:
        return failed_beat(str(failure), period, heart.trigger, {})
    return simulate(heart, body, replace(scheme.numerics(), keep_positions=keep_positions), progress)


def beats_of_points(
    mesh: VentricularMesh,
    setting: Setting,
    period: float,
    points: Iterable[SigmaPoint],
    pressures: Pressures,
    scheme: TimeScheme,
) -> Iterator[Beat]:
    """Yield the beat of each point, simulated when it is asked for."""
    for point in points:
        yield run_beat(mesh, setting, period, point.parameters, pressures, scheme)


def nearby_beats(
    mesh: VentricularMesh,
    setting: Setting,
    period: float,
    parameters: Sequence[Mapping[str, float]],
    size: float,
    pressures: Pressures,
    scheme: TimeScheme,
) -> list[Beat]:
    """Return the beat with the first ``parameters`` on its limit cycle, and to first order those with the others.

    The others are those at the distance ``size`` along one coordinate each. Raises InputError or StepFailed where the
    first heart has no beat, and InputError for spheres and where an atrium has a volume in some hearts only.
    """
    if setting.element == "sphere":
        raise InputError("tangent: spheres have no derivatives; expected finite elements")
    loads = np.array([pressures.lv, pressures.rv])
    hearts = [setting.base_heart(period).with_parameters(values) for values in parameters]
    centre, *others = (LoadedHeart(heart, mesh, loads) for heart in hearts)
    body, neighbours = surround(centre, others, size, setting.reference == "unloaded")
    tangent = differentiate(centre.heart, body, neighbours, tangent_numerics(scheme.numerics()))
    return [tangent.beat, *map(tangent.near, range(len(neighbours)))]


def estimate(
    setting: Setting,
    around: Gaussian,
    points: Sequence[SigmaPoint],
    beats: Iterable[Beat],
    measured: Mapping[str, Curve],
    measurement: Measurement,
    operator: Operator,
    transform: Transform,
    slopes: Slopes | None = None,
) -> Posterior:
    """Return the posterior from the beats of all sigma points, in their order, each observed by its sensors.

    ``around`` is the Gaussian of the points: in the first iteration the prior of the setting.
    Only the observations of the setting's curves are used. Without the noise that transform or setting asks for, the
    measured values are fitted exactly, as in the paper; with it, the bias-corrected values with their covariance.
    ``slopes`` add the uncertainty due to parameters that are not estimated.
    """
    sensors = [setting.sensors(point.parameters) for point in points]
    features = operator.features(measured, setting.observe)
    measurement = measurement.of([name for observer in features.values() for name in observer.names])
    noise = measurement.covariance if transform.noise or setting.noise else None
    if noise is not None and slopes is not None:
        noise = noise + slopes.covariance(setting.estimate, measurement.corrected, transform.fixed_sd)
    observed = measurement.values if noise is None else measurement.corrected
    outcomes = observe_beats(beats, features, sensors)
    if setting.iterations == 1:
        return calibrate(around, outcomes, observed, noise, transform.scaling())
    return calibrate(setting.gaussian(), outcomes, observed, noise, transform.scaling(), around)


def gaussian_of_points(setting: Setting, first: Sequence[Posterior]) -> Gaussian:
    """Return the Gaussian of the sigma points: the prior, or a narrower one at the estimate of the first iteration.

    first: posterior of the first iteration, empty where this is the first.
    """
    prior = setting.gaussian()
    return narrowed(prior, first[0].estimate.mean) if first else prior


def observe_plausibility(
    setting: Setting, points: Sequence[SigmaPoint], beats: Iterable[Beat], operator: Operator
) -> list[Outcome]:
    """Return the observations and the cavity indices of each beat, which limit its plausibility, or its failure.

    The observations are the six of the paper and those of the right ventricle.

    EDV, ESV and SV [m^3] and EF [1] are not smoothed by the operator, as published values are not.
    """
    features = operator.trial_features(operator.frames) | operator.right_features(operator.frames)
    outcomes: list[Outcome] = []
    for point, beat in zip(points, beats, strict=True):
        curves = beat_curves(beat, setting.sensors(point.parameters))
        outcomes.append(observe(curves, features) | cavity_indices(curves) if curves else beat.reason)
    return outcomes


def curves_of_points(
    setting: Setting, points: Sequence[SigmaPoint], beats: Iterable[Beat]
) -> dict[str, dict[str, Curve]]:
    """Return the curves of each point's beat by its label, empty for a failed beat."""
    return {
        point.label: beat_curves(beat, setting.sensors(point.parameters))
        for point, beat in zip(points, beats, strict=True)
    }


def observe_case(
    measured: Mapping[str, Curve],
    operator: Operator,
    models: Sequence[NoiseModel],
    protocol: Mapping[str, float | int | str | bool],
    also: Collection[str] = (),
) -> Measurement:
    """Observe a case, with the noise model of its images if given; ``also`` as in :func:`operators`.

    The period of synthetic images is known; that of a measured heart varies between breath-holds. Raises InputError for
    a model of another protocol.
    """
    features = operator.features(measured, also)
    for model in models:
        model.require_protocol(protocol)
        return observe_measured(measured, features, 0.0, model)
    return observe_measured(measured, features, operator.period_uncertainty)
