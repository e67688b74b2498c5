r"""What the search leaves free of every heart: twenty unknowns, each about a centre.

.. math:: \theta = \theta_0 e^{s x} \quad\text{or}\quad \theta = \theta_0 + s x \text{ (times)}, \qquad x \sim N(0, 1) .

The calibrated parameters are among them and none of the others is frozen: a parameter held at a wrong value leaves a
misfit that the next best mechanism explains, in every heart (docs/discovery.md). Size is free through the volume of the
stress-free cavity.
"""

from dataclasses import dataclass, replace
from math import exp

from heartfit.diagnosis.centre import Centre
from heartfit.geometry.arrays import Floats
from heartfit.mechanics.sphere import Sphere
from heartfit.sphere.heart import Inertia


@dataclass(frozen=True)
class Free:
    """Parameters by their paths below the heart, which scatter as one, and their standard deviation.

    That is of their logarithms or, where they add, of a time in s.
    """

    paths: tuple[str, ...]
    sd: float
    additive: bool = False

    @property
    def name(self) -> str:
        """The first path."""
        return self.paths[0]

    def at(self, centre: float, x: float) -> float:
        """Its value x standard deviations from the centre."""
        return centre + self.sd * x if self.additive else centre * exp(self.sd * x)


CAVITY = Free(("cavity",), 0.15)
PARAMETERS = (
    Free(("tissue.active.sigma_0",), 0.20),
    Free(("tissue.active.mu",), 0.30),
    Free(("tissue.passive.c_1",), 0.30),
    Free(("circulation.systemic.R_p",), 0.20),
    Free(("tissue.control.k_RS",), 0.20),
    Free(("tissue.control.k_ATP",), 0.20),
    Free(("circulation.systemic.tau",), 0.20),
    Free(("circulation.systemic.Z_c",), 0.20),
    Free(("circulation.systemic.L",), 0.30),
    Free(("tissue.active.k_0",), 0.30),
    Free(("tissue.active.alpha",), 0.30),
    Free(("circulation.left_atrium", "AtrialKick.rise"), 0.15),
    Free(("circulation.mitral.open",), 0.25),
    Free(("circulation.aortic.open",), 0.40),
    Free(("tissue.passive.eta",), 0.30),
    Free(("tissue.control.duration",), 0.015, additive=True),
    Free(("tissue.control.onset",), 0.008, additive=True),
    Free(("tissue.control.trigger_delay",), 0.008, additive=True),
)
INERTANCE = Free(("mitral_inertance",), 0.40)
FREE = (CAVITY, INERTANCE, *PARAMETERS)
UNFELT = FREE.index(PARAMETERS[-1])
"""The coordinate that the beat does not feel: it says which instant of it the recording calls zero."""


def free_parameters(centre: Centre, x: Floats) -> dict[str, float]:
    """The parameters by path at the first coordinates of x, SI."""
    pairs = [(each, path, z) for each, z in zip(PARAMETERS, x[2:], strict=False) for path in each.paths]
    return {path: each.at(centre.values[path], float(z)) for each, path, z in pairs}


def free_sphere(centre: Centre, x: Floats) -> Sphere:
    """The sphere whose stress-free cavity is x[0] standard deviations from the centre's, of the same wall."""
    return Sphere.of(CAVITY.at(centre.cavity, float(x[0])), centre.wall)


def free_inertia(centre: Centre, x: Floats) -> Inertia:
    """The centre's inertia, its mitral valve x[1] standard deviations from the centre's."""
    factor = INERTANCE.at(1.0, float(x[1]))
    valves = [(name, value * (factor if name == "mitral" else 1.0)) for name, value in centre.inertia.valves]
    return replace(centre.inertia, valves=tuple(valves))
