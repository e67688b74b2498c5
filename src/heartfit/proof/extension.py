r"""A setting, and what is added to it: every unknown a coordinate of its own prior.

.. math:: \theta_i = \bar\theta_i e^{s_i x_i}, \qquad x \sim N(0, 1),

for what the setting estimates; the unknowns of a mechanism as the search on the sphere takes them, its amplitude first.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.configuration.setting import Setting
from heartfit.diagnosis.library import Candidate
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import registered


@dataclass(frozen=True)
class Extension:
    """A setting with its prior complete, and the mechanisms that it is extended by, none if empty.

    element: another one than the setting's, for a misfit may be the simulator's and not the patient's.
    """

    base: Setting
    added: tuple[Candidate, ...] = ()
    element: Literal["mixed", "p1", "sphere"] | None = None

    @classmethod
    def by(cls, base: Setting, *names: str) -> "Extension":
        """By mechanisms of the registry."""
        return cls(base, tuple(Candidate.of(registered()[name]) for name in names))

    @property
    def setting(self) -> Setting:
        """The setting with the mechanisms in it."""
        names = (*self.base.mechanisms, *self.effects)
        return self.base.model_copy(
            update={"mechanisms": names, "element": self.element or self.base.element}
        )

    @property
    def effects(self) -> tuple[str, ...]:
        """The mechanisms by name."""
        return tuple(each.name for each in self.added)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the coordinates (d,): parameters of the setting, then "MitralRegurgitation.area", ..."""
        unknowns = [f"{each.name}.{unknown.name}" for each in self.added for unknown in each.unknowns]
        return (*self.base.estimate, *unknowns)

    @property
    def one_sided(self) -> np.ndarray:
        """Which coordinates cannot be negative (d,)."""
        unknowns = [unknown.one_sided for each in self.added for unknown in each.unknowns]
        return np.array([False] * len(self.base.estimate) + unknowns)

    def prior(self) -> Gaussian:
        """N(0, I) of the coordinates."""
        return Gaussian(self.names, np.zeros(len(self.names)), np.eye(len(self.names)))

    def parameters(self, x: Floats) -> dict[str, float]:
        """All parameters at coordinates (d,), by name, SI."""
        prior = self.base.gaussian()
        count = len(prior.names)
        values = prior.physical(prior.mean + prior.sd * x[:count])
        unknowns = [unknown for each in self.added for unknown in each.unknowns]
        added = [unknown.at(float(z)) for unknown, z in zip(unknowns, x[count:], strict=True)]
        return values | dict(zip(self.names[count:], added, strict=True))

    def start(self, amplitude: float = 1.0) -> Floats:
        """The centre of the priors (d,), the mechanisms on by so many scales."""
        switched = [unknown.off is not None for each in self.added for unknown in each.unknowns]
        return np.array([0.0] * len(self.base.estimate) + [amplitude * on for on in switched])
