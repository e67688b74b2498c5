r"""Three-dimensional model of a case, and its extension by mechanisms.

Every unknown of an extension is a coordinate with a prior. Those of estimated parameters are

.. math:: \theta_i = \bar\theta_i e^{s_i x_i}, \qquad x \sim N(0, 1) .

Parameters that are fixed in the setting and free in the search on the sphere, and the unknowns of a mechanism, have
the priors of that search.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.sphere_model.free_parameters import HEART_PARAMETERS, FreeParameter
from heartfit.discovery.sphere_model.recentred import centred_search
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.activation.conduction import HEALTHY, assign_activation, fit_conduction
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.numerics import Pressures, TimeScheme
from heartfit.personalise.run import run_beat
from heartfit.personalise.setting import Element, Setting
from heartfit.places import Place
from heartfit.roles import registered

RIGHT_PARAMETERS = (
    FreeParameter(("tissue.right.contractility",), 0.25),
    FreeParameter(("tissue.right.delay",), 0.6),
    FreeParameter(("circulation.pulmonary_tree.Z_c",), 0.25),
    FreeParameter(("circulation.right_atrium",), 0.25),
    FreeParameter(("AtrialKick.right",), 0.3),
)
"""Unknowns of the right ventricle, free where its volume is fitted. A heart without a delay keeps none: its prior is
log-normal. The peripheral resistance and the stiffness are left out: a volume alone does not decide them."""


@dataclass(frozen=True)
class Extension:
    """A setting with its complete prior, and added mechanisms, possibly none.

    freed: further unknowns that the setting does not estimate; element: replaces the setting's, since the
    simulator may cause a misfit.
    """

    base: Setting
    added: tuple[Candidate, ...] = ()
    element: Element | None = None
    freed: tuple[FreeParameter, ...] = ()

    @classmethod
    def from_names(cls, base: Setting, *names: str) -> "Extension":
        """Return the setting extended by mechanisms of the registry."""
        return cls(base, tuple(Candidate.from_mechanism(registered()[name]) for name in names))

    def with_free_parameters(self, right: bool = False) -> "Extension":
        """Return the extension with all parameters of the search free; a wrong fixed value would resemble an effect.

        right: those of the right ventricle are free, too.
        """
        freed = tuple(
            parameter
            for parameter in (*HEART_PARAMETERS, *(RIGHT_PARAMETERS if right else ()))
            if parameter.name.rsplit(".", 1)[-1] not in self.base.estimate
        )
        return replace(self, freed=freed)

    @property
    def setting(self) -> Setting:
        """Return the setting with the added mechanisms."""
        names = (*self.base.mechanisms, *self.effects)
        return self.base.model_copy(
            update={"mechanisms": names, "element": self.element or self.base.element}
        )

    @property
    def effects(self) -> tuple[str, ...]:
        """Names of the added mechanisms."""
        return tuple(mechanism.name for mechanism in self.added)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates (d,): estimated parameters, freed ones, then "MitralRegurgitation.area", ..."""
        unknowns = [f"{effect.name}.{unknown.name}" for effect in self.added for unknown in effect.unknowns]
        return (*self._base_names, *unknowns)

    @property
    def _base_names(self) -> tuple[str, ...]:
        """Names of the coordinates of the model without any added mechanism."""
        return (*self.base.estimate, *(parameter.name for parameter in self.freed))

    @property
    def one_sided(self) -> np.ndarray:
        """Mask (d,) of the coordinates that cannot be negative."""
        unknowns = [unknown.one_sided for effect in self.added for unknown in effect.unknowns]
        return np.array([False] * len(self._base_names) + unknowns)

    def prior(self) -> Gaussian:
        """N(0, I) of the coordinates."""
        return Gaussian(self.names, np.zeros(len(self.names)), np.eye(len(self.names)))

    def parameters(self, x: Floats) -> dict[str, float]:
        """All parameters at the coordinates (d,), by name [SI]."""
        prior, nominal = self.base.gaussian(), self.base.base_heart(period=1.0).parameters()
        estimated, base = len(prior.names), len(self._base_names)
        values = prior.physical(prior.mean + prior.sd * x[:estimated])
        unknowns = [unknown for effect in self.added for unknown in effect.unknowns]
        added = [unknown.at(float(z)) for unknown, z in zip(unknowns, x[base:], strict=True)]
        for parameter, z in zip(self.freed, x[estimated:base], strict=True):
            values |= {path: parameter.at(nominal[path], float(z)) for path in parameter.paths}
        return values | dict(zip(self.names[base:], added, strict=True))

    def start(self, amplitude: float = 1.0) -> Floats:
        """The prior mean (d,), with the mechanisms switched on at ``amplitude`` scales."""
        is_amplitude = [unknown.off is not None for effect in self.added for unknown in effect.unknowns]
        return np.array([0.0] * len(self._base_names) + [amplitude * on for on in is_amplitude])


@dataclass(frozen=True, eq=False)
class Model:
    """The simulator of a case: maps an extended setting and its parameters, by name [SI], to their beat."""

    mesh: VentricularMesh
    period: float
    pressures: Pressures
    scheme: TimeScheme

    def __call__(
        self, extension: Extension, parameters: Mapping[str, float], keep_positions: bool = False
    ) -> Beat:
        return run_beat(
            self.mesh,
            extension.setting,
            self.period,
            parameters,
            self.pressures,
            self.scheme,
            keep_positions=keep_positions,
        )


@dataclass(frozen=True, eq=False)
class ObservedBeat:
    """Observations of a completed beat: curves by name, and the wall's motion from the trigger on."""

    curves: Mapping[str, Curve]
    motion: Motion

    @classmethod
    def from_beat(cls, beat: Beat, extension: Extension, parameters: Mapping[str, float]) -> "ObservedBeat":
        """Observe a beat that kept its nodes."""
        return cls(beat_curves(beat, extension.setting.sensors(parameters)), nodal_motion(beat))


@dataclass(frozen=True, eq=False)
class Reference:
    """A model of a heart before any fit: its wall at end diastole, its setting and its numerics."""

    mesh: VentricularMesh
    setting: Setting
    pressures: Pressures
    scheme: TimeScheme

    def search(
        self, recording: Recording, places: Sequence[type[Place]] = (), left_out: Collection[str] = ()
    ) -> Diagnosis:
        """Diagnose a recording of this wall with a sphere centred on the beat at the prior mean.

        places, left_out: see :func:`heartfit.discovery.sphere_model.diagnose.diagnose`. Raises InputError where that
        beat fails.
        """
        mesh = activate(self.mesh)
        beat = run_beat(mesh, self.setting, recording.period, {}, self.pressures, self.scheme)
        if not beat.completed:
            raise InputError(f"reference beat: {beat.reason}; expected one: choose another prior or mesh")
        heart = self.setting.base_heart(recording.period)
        return centred_search(recording, heart, [beat_curves(beat)], places=places, left_out=left_out)


def activate(mesh: VentricularMesh) -> VentricularMesh:
    """The mesh with fibres, regions and the activation of a healthy conduction."""
    prepared = prepare(mesh)
    return assign_activation(prepared, fit_conduction(prepared, HEALTHY, None))
