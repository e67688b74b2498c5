r"""A setting, and what is added to it: every unknown a coordinate of its own prior.

.. math:: \theta_i = \bar\theta_i e^{s_i x_i}, \qquad x \sim N(0, 1),

for what the setting estimates; what it holds fixed and the search on the sphere leaves free, and the unknowns of a
mechanism, as that search takes them.
"""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.configuration.setting import Element, Setting
from heartfit.diagnosis.free import PARAMETERS, Free
from heartfit.diagnosis.library import Candidate
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import registered


@dataclass(frozen=True)
class Extension:
    """A setting with its prior complete, and the mechanisms that it is extended by, none if empty.

    freed: parameters that are unknown as well, though the setting does not estimate them; element: another one than
    the setting's, for a misfit may be the simulator's and not the patient's.
    """

    base: Setting
    added: tuple[Candidate, ...] = ()
    element: Element | None = None
    freed: tuple[Free, ...] = ()

    @classmethod
    def by(cls, base: Setting, *names: str) -> "Extension":
        """By mechanisms of the registry."""
        return cls(base, tuple(Candidate.of(registered()[name]) for name in names))

    def freeing(self) -> "Extension":
        """The same with all unknown that the search leaves free: frozen at a wrong value it looks like an effect."""
        held = (each for each in PARAMETERS if each.name.rsplit(".", 1)[-1] not in self.base.estimate)
        return replace(self, freed=tuple(held))

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
        """Of the coordinates (d,): parameters of the setting, freed ones, then "MitralRegurgitation.area", ..."""
        unknowns = [f"{each.name}.{unknown.name}" for each in self.added for unknown in each.unknowns]
        return (*self._sound, *unknowns)

    @property
    def _sound(self) -> tuple[str, ...]:
        """Names of the coordinates that the model has without any mechanism."""
        return (*self.base.estimate, *(each.name for each in self.freed))

    @property
    def one_sided(self) -> np.ndarray:
        """Which coordinates cannot be negative (d,)."""
        unknowns = [unknown.one_sided for each in self.added for unknown in each.unknowns]
        return np.array([False] * len(self._sound) + unknowns)

    def prior(self) -> Gaussian:
        """N(0, I) of the coordinates."""
        return Gaussian(self.names, np.zeros(len(self.names)), np.eye(len(self.names)))

    def parameters(self, x: Floats) -> dict[str, float]:
        """All parameters at coordinates (d,), by name, SI."""
        prior, centre = self.base.gaussian(), self.base.base_heart(period=1.0).parameters()
        estimated, sound = len(prior.names), len(self._sound)
        values = prior.physical(prior.mean + prior.sd * x[:estimated])
        unknowns = [unknown for each in self.added for unknown in each.unknowns]
        added = [unknown.at(float(z)) for unknown, z in zip(unknowns, x[sound:], strict=True)]
        for each, z in zip(self.freed, x[estimated:sound], strict=True):
            values |= {path: each.at(centre[path], float(z)) for path in each.paths}
        return values | dict(zip(self.names[sound:], added, strict=True))

    def start(self, amplitude: float = 1.0) -> Floats:
        """The centre of the priors (d,), the mechanisms on by so many scales."""
        switched = [unknown.off is not None for each in self.added for unknown in each.unknowns]
        return np.array([0.0] * len(self._sound) + [amplitude * on for on in switched])
