r"""Extension of a setting by mechanisms, and the priors of all its unknowns.

Every unknown of an extension is a coordinate with a prior. Those of estimated parameters are

.. math:: \theta_i = \bar\theta_i e^{s_i x_i}, \qquad x \sim N(0, 1) .

Parameters that are fixed in the setting and free in the search on the sphere, and the unknowns of a mechanism, have
the priors of that search.
"""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.sphere_model.free_parameters import HEART_PARAMETERS, FreeParameter
from heartfit.personalise.setting import Element, Setting
from heartfit.roles import registered

RIGHT_PARAMETERS = (
    FreeParameter(("tissue.right.contractility",), 0.25),
    FreeParameter(("tissue.right.delay",), 0.6),
    FreeParameter(("circulation.pulmonary_tree.tau",), 0.25),
    FreeParameter(("circulation.pulmonary_tree.Z_c",), 0.25),
    FreeParameter(("circulation.pulmonary_tree.L",), 0.30),
    FreeParameter(("circulation.tricuspid.open",), 0.40),
    FreeParameter(("circulation.pulmonary.open",), 0.40),
    FreeParameter(("circulation.right_atrium",), 0.25),
    FreeParameter(("AtrialKick.right",), 0.3),
)
"""Unknowns of the right ventricle, free where its volume was measured: as on the left those of its muscle, arteries,
valves and atrium. A heart without a delay keeps none: its prior is log-normal. The peripheral resistance and the
stiffness are left out: a volume alone does not decide them."""


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
