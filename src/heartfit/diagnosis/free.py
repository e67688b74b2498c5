r"""What the search leaves free of every heart: twenty-three unknowns, each about a centre.

.. math:: \theta = \theta_0 e^{s x} \quad\text{or}\quad \theta = \theta_0 + s x, \qquad x \sim N(0, 1) ,

the latter for times, and for the length dependence, which a three-dimensional centre may not have at all.

The calibrated parameters are among them and none of the others is frozen: a parameter held at a wrong value leaves a
misfit that the next best mechanism explains, in every heart (docs/discovery.md). Size is free through the volume of the
stress-free cavity.
"""

from dataclasses import dataclass, replace
from math import exp

from heartfit.diagnosis.centre import Centre
from heartfit.geometry.arrays import Floats


@dataclass(frozen=True)
class Free:
    """Parameters by their paths below the heart, which scatter as one, and their standard deviation.

    That is of their logarithms or, where they add, of themselves, SI.
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


OF_THE_SPHERE = (
    Free(("cavity",), 0.15),
    Free(("spread",), 0.20),
    Free(("mitral_inertance",), 0.40),
    Free(("aortic_inertance",), 0.40),
)
"""What the heart itself does not know: its volume, for how long it is activated, and the blood that moves in valves."""
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
    Free(("tissue.active.starling.slope",), 0.10, additive=True),
    Free(("circulation.left_atrium",), 0.15),
    Free(("circulation.mitral.open",), 0.40),
    Free(("circulation.aortic.open",), 0.40),
    Free(("tissue.passive.eta",), 0.30),
    Free(("tissue.control.duration",), 0.015, additive=True),
    Free(("tissue.control.onset",), 0.008, additive=True),
    Free(("tissue.control.trigger_delay",), 0.008, additive=True),
)
FREE = (*OF_THE_SPHERE, *PARAMETERS)
UNFELT = FREE.index(PARAMETERS[-1])
"""The coordinate that the beat does not feel: it says which instant of it the recording calls zero."""


def moved(centre: Centre, x: Floats) -> Centre:
    """The centre moved to the first coordinates of x."""
    cavity, spread, *inertances = (each.at(1.0, float(z)) for each, z in zip(OF_THE_SPHERE, x, strict=False))
    factors = dict(zip(("mitral", "aortic"), inertances, strict=True))
    valves = tuple((name, value * factors.get(name, 1.0)) for name, value in centre.inertia.valves)
    return replace(
        centre,
        heart=centre.heart.with_parameters(_parameters(centre, x[len(OF_THE_SPHERE) :])),
        cavity=cavity * centre.cavity,
        spread=spread * centre.spread,
        inertia=replace(centre.inertia, valves=valves),
    )


def _parameters(centre: Centre, x: Floats) -> dict[str, float]:
    """Parameters of the heart by path, SI."""
    pairs = [(each, path, z) for each, z in zip(PARAMETERS, x, strict=False) for path in each.paths]
    return {path: each.at(centre.values[path], float(z)) for each, path, z in pairs}
