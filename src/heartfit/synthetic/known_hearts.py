"""Sphere forward model, and spherical hearts of known truth drawn from it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Self, get_args

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.passive import require_isotropic
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import observe_beats
from heartfit.observation.operator import CurveFeatures
from heartfit.synthetic.volunteer import OTHER_MODEL, OTHER_SPREAD, OTHERS, VALVES

UNFILLED = "no stress-free sphere has this volume under the end-diastolic pressure"
"""Reason of a failed unloading."""


@dataclass(frozen=True)
class SphericalCase:
    """Sphere forward model of a subject: parameters by name, SI, to the observations of the beat.

    cavity, wall: volumes [m^3] at the end-diastolic ``pressure`` [Pa]; features: operator of each observed curve. As in
    the study, the stress-free reference is computed for the parameters of each call. The right ventricle is left out:
    it does not enter the observations and acts on the left one through the septum only.
    """

    heart: Heart
    cavity: float
    wall: float
    pressure: float
    features: Mapping[str, CurveFeatures]
    numerics: Numerics = field(default_factory=Numerics)

    @classmethod
    def of(
        cls,
        mesh: VentricularMesh,
        pressure: float,
        heart: Heart,
        features: Mapping[str, CurveFeatures],
        numerics: Numerics,
    ) -> Self:
        """Create the model with the volumes of a mesh; the septum belongs to the left ventricle."""
        cavity = Cavity.from_endocardium(mesh, "lv_endo").volume(mesh.points)
        wall = mesh.element_volumes()[np.asarray(mesh.segments) != 0].sum()
        return cls(heart, float(cavity), float(wall), pressure, features, numerics)

    def __call__(self, parameters: Mapping[str, float]) -> dict[str, float] | str:
        """Return the observations, or the reason of a failed beat."""
        return self.observe(self.heart.with_parameters(parameters))

    def observe(self, heart: Heart) -> dict[str, float] | str:
        """Return the observations of another heart in a ventricle of this shape, or the reason of a failed beat."""
        try:
            sphere = Sphere.unloaded(
                self.cavity, self.wall, self.pressure, require_isotropic(heart.muscle.passive)
            )
        except ValueError:
            return UNFILLED
        return observe_beats([simulate_spheres(heart, [sphere], self.numerics)], self.features)[0]

    def observe_all(self, parameters: Sequence[Mapping[str, float]]) -> list[Mapping[str, float] | str]:
        """Return the outcome of each parameter set, in the form that a calibration needs."""
        return [self(parameter_set) for parameter_set in parameters]

    def slopes(self, names: Sequence[str], observations: Sequence[str], step: float) -> Floats:
        """Return dZ/dln p (k, m) at the standard values, by central differences over +- step of the logarithms.

        Raises ValueError if a beat on either side fails.
        """
        values = self.heart.parameters()
        nominal = {name: values[self.heart.parameter_path(name)] for name in names}
        up, down = (
            self.observe_all([{name: value * float(np.exp(sign * step))} for name, value in nominal.items()])
            for sign in (1.0, -1.0)
        )
        return (_rows(up, observations) - _rows(down, observations)) / (2.0 * step)


def _rows(outcomes: Sequence[Mapping[str, float] | str], names: Sequence[str]) -> Floats:
    """Return the observations (k, m) of k completed beats; raise ValueError for a failed one."""
    failed = [outcome for outcome in outcomes if isinstance(outcome, str)]
    if failed:
        raise ValueError(f"sphere: {failed[0]}; expected a beat on either side of the standard values")
    rows = [[outcome[name] for name in names] for outcome in outcomes if not isinstance(outcome, str)]
    return np.array(rows).reshape(len(outcomes), len(names))


World = Literal["nothing", "parameters", "model"]
"""Unknowns of the calibrator other than the estimated parameters: nothing; the values of other parameters, which it
holds fixed; these and the model itself, as in :mod:`heartfit.synthetic.volunteer`."""
WORLDS: tuple[World, ...] = get_args(World)
BRANCHES = ("mitral", "aortic", "tricuspid", "pulmonary")


@dataclass(frozen=True, eq=False)
class KnownHeart:
    """Heart of known truth: logarithms of its parameters (n,), observations, and their noise covariance R (m, m)."""

    truth: Floats
    observed: Mapping[str, float]
    noise: Floats


@dataclass(frozen=True, eq=False)
class KnownHeartSampler:
    """Sampler of hearts: the calibrator's model and prior, relative standard deviation of each observation, and seed.

    All hearts share one shape; they differ in the estimated parameters and in the unknowns of the calibrator.
    """

    model: SphericalCase
    prior: Gaussian
    noise: Mapping[str, float]
    seed: int

    @property
    def fixed(self) -> tuple[str, ...]:
        """Parameters that scatter but are not estimated."""
        return tuple(name for name in OTHERS if name not in self.prior.names)

    def draw(self, number: int, world: World) -> KnownHeart:
        """Draw heart ``number``, with the same deviates in every world; a heart whose beat fails is drawn anew."""
        rng = np.random.default_rng([self.seed, number])
        n, others, m = len(self.prior.names), len(self.fixed), len(self.noise)
        while True:
            estimated, fixed, error = np.split(rng.standard_normal(n + others + m), [n, n + others])
            truth = self.prior.mean + np.linalg.cholesky(self.prior.covariance) @ estimated
            outcome = self.model.observe(self._heart(truth, fixed, world))
            if not isinstance(outcome, str):
                return self._measure(truth, outcome, error)

    def _heart(self, truth: Floats, deviates: Floats, world: World) -> Heart:
        heart = self.model.heart.with_parameters(self.prior.physical(truth))
        if world == "nothing":
            return heart
        values = heart.parameters()
        ratios = zip(self.fixed, np.exp(OTHER_SPREAD * deviates).tolist(), strict=True)
        heart = heart.with_parameters(
            {name: values[heart.parameter_path(name)] * ratio for name, ratio in ratios}
        )
        return heart if world == "parameters" else _with_other_model(heart)

    def _measure(self, truth: Floats, true: Mapping[str, float], deviates: Floats) -> KnownHeart:
        sd = np.array([self.noise[name] for name in true])
        observed = np.array(list(true.values())) * (1.0 + sd * deviates)
        return KnownHeart(
            truth, dict(zip(true, observed.tolist(), strict=True)), np.diag(np.square(sd * observed))
        )


def _with_other_model(heart: Heart) -> Heart:
    valves = {name: getattr(VALVES, name) for name in BRANCHES}
    other = replace(heart, circulation=replace(heart.circulation, **valves))
    return other.with_parameters(OTHER_MODEL)
