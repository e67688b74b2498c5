"""The steps of a calibration, each from values to values: what the workflow's scripts and the command line call."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from heartfit.beat import Beat
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.update import Posterior, calibrate
from heartfit.configuration.setting import Setting
from heartfit.configuration.study import Operator, Pressures, TimeScheme, Transform
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics.body import FiniteElementBody
from heartfit.mechanics.unloading import unload
from heartfit.observation.beat import beat_curves, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.noise import Observation
from heartfit.observation.vector import cavity_indices
from heartfit.simulation import Progress, simulate
from heartfit.tables.case import CaseResult, summarise


def stress_free(
    mesh: VentricularMesh, setting: Setting, period: float, pressures: Pressures
) -> VentricularMesh:
    """The reference state of a mesh measured at end diastole, found once, at the mean of the prior.

    With the reference "end_diastolic" (the paper's assumption) it is the mesh itself.
    """
    if setting.reference == "end_diastolic":
        return mesh
    return unload(mesh, setting.base_heart(period).tissue, np.array([pressures.lv, pressures.rv]))


def run_beat(
    reference: VentricularMesh,
    setting: Setting,
    period: float,
    parameters: Mapping[str, float],
    scheme: TimeScheme,
    progress: Progress | None = None,
) -> Beat:
    """The beat of a setting with some parameters changed."""
    heart = setting.base_heart(period).with_parameters(parameters)
    return simulate(heart, FiniteElementBody(reference, heart.tissue), scheme.numerics(), progress)


def estimate(
    prior: Gaussian,
    beats: Iterable[Beat],
    observations: Sequence[Observation],
    operator: Operator,
    transform: Transform,
) -> Posterior:
    """The posterior from the beats of all sigma points, in their order."""
    noise = np.diag([each.noise**2 for each in observations]) if transform.noise else None
    observed = {each.name: each.value for each in observations}
    outcomes = observe_beats(beats, operator.features())
    return calibrate(prior, outcomes, observed, noise, transform.scaling())


def compare(
    identity: Mapping[str, str],
    posterior: Posterior,
    observations: Sequence[Observation],
    measured: Mapping[str, Curve],
    points: Sequence[Beat],
    calibrated: Beat,
    setting: Setting,
    operator: Operator,
) -> CaseResult:
    """The record of a case: what was measured against the beats at the prior's mean and at the estimate.

    identity: case, setting, fingerprint; points: the beats of all sigma points, of which the first is the centre.
    """
    names, beats = ("reference", "calibrated"), (points[0], calibrated)
    predicted = [each or {} for each in observe_beats(beats, operator.features())]
    return summarise(
        identity,
        posterior,
        observations,
        dict(zip(names, predicted, strict=True)),
        {"measured": measured, **dict(zip(names, map(beat_curves, beats), strict=True))},
        setting.units(),
        [beat.completed for beat in points],
        _guards(calibrated),
    )


def _guards(beat: Beat) -> dict[str, float]:
    """What was not observed and must hold all the same: volumes, peak pressures and the wall's volume."""
    if not beat.completed:
        return {}
    curves = beat_curves(beat)
    volumes = {
        f"{side}_{name}": value
        for side in ("lv", "rv")
        for name, value in cavity_indices(curves, side).items()
    }
    peaks = {f"{side}_P_max": float(beat.pressure[side].max()) for side in ("lv", "rv")}
    return {**volumes, **peaks, **beat.diagnostics}
