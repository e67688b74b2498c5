r"""Beats of hearts drawn at random from the prior of the paper's fourteen parameters.

Each parameter is log-normal about its declared value, :math:`\theta = \theta_0 e^{s z}` with its declared
deviation s and :math:`|z| \le 3`: a normal variable cut there, or, to try the corners that a normal one hardly
ever sees in fourteen dimensions, a uniform one.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from heartfit.beat import Beat
from heartfit.catalogue import declared
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import FOURTEEN, Heart
from heartfit.mechanics.body import StepFailed, Tissue
from heartfit.simulation import Numerics, simulate
from heartfit.ventricles import ventricles
from heartfit.verification.specimen import END_DIASTOLIC_PRESSURE

CUT = 3.0
"""Largest |z|."""

PAPER_SCALE = MappingProxyType({"sigma_0": 5.8e6, "mu": 0.3e6, "K": 12.9e6, "R_p": 1.137e8})
"""Means of the paper's Table 2, SI."""

Law = Callable[[np.random.Generator, tuple[int, int]], Floats]


def normal(rng: np.random.Generator, shape: tuple[int, int]) -> Floats:
    """Standard normal numbers, drawn again while beyond the cut."""
    z = rng.standard_normal(shape)
    while (far := np.abs(z) > CUT).any():
        z[far] = rng.standard_normal(int(far.sum()))
    return z


def uniform(rng: np.random.Generator, shape: tuple[int, int]) -> Floats:
    """Uniform numbers up to the cut."""
    return rng.uniform(-CUT, CUT, shape)


@dataclass(frozen=True)
class Campaign:
    """``count`` hearts of an element, about the declared values or those of ``centre``, from one seed."""

    name: str
    element: str
    law: Law
    count: int
    seed: int
    centre: Mapping[str, float] = field(default_factory=dict)

    def draws(self) -> Floats:
        """z (count, 14)."""
        return self.law(np.random.default_rng(self.seed), (self.count, len(FOURTEEN)))

    def hearts(self) -> Iterator[Heart]:
        """The hearts in the order of the draws."""
        known = [declared(name) for name in FOURTEEN]
        centre = np.array([self.centre.get(each.name, each.value) for each in known])
        deviation = np.array([each.sd for each in known], dtype=float)
        for z in self.draws():
            values = dict(zip(FOURTEEN, centre * np.exp(deviation * z), strict=True))
            yield Heart(tissue=Tissue(element=self.element)).with_parameters(values)


CAMPAIGNS = (
    Campaign("the prior", "mixed", normal, 300, 1),
    Campaign("its corners", "mixed", uniform, 100, 2),
    Campaign("the paper's scale", "p1", normal, 50, 3, PAPER_SCALE),
)


@dataclass(frozen=True)
class Trial:
    """What came of one heart: whether it could be unloaded, its first beat, and why it ended otherwise."""

    unloaded: bool
    beat: Beat | None
    reason: str

    @property
    def completed(self) -> bool:
        """Whether there is a beat to observe."""
        return self.beat is not None and self.beat.completed


def attempt(heart: Heart, mesh: VentricularMesh, numerics: Numerics | None = None) -> Trial:
    """Unload the ventricles and run their first beat."""
    try:
        body = ventricles(mesh, heart.muscle, END_DIASTOLIC_PRESSURE)
    except StepFailed as failure:
        return Trial(False, None, str(failure))
    beat = simulate(heart, body, numerics or Numerics(max_beats=1))
    return Trial(True, beat, beat.reason)
