"""Shapes of healthy hearts, drawn about normal values.

References
----------
Hudsmith LE et al. 2005, J Cardiovasc Magn Reson 7:775: volumes of both ventricles, women and men together. The other
numbers are those of a parametric ventricle with a plausible ejection fraction.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.parametric import ParametricVentricles

EDV, WALL, SPHERICITY, RIGHT_WALL, PERIOD = (
    (148e-6, 24e-6),
    (8.3e-3, 0.7e-3),
    (1.85, 0.08),
    (3.5e-3, 0.2e-3),
    (0.9, 0.07),
)
"""Mean and standard deviation of each, SI."""

RIGHT_OVER_LEFT = (1.04, 0.04)
"""Right end-diastolic volume over the left one."""

FURTHEST = 2.0
"""Standard deviations at which a draw is cut off."""


AVERAGE = ParametricVentricles(EDV[0], WALL[0], SPHERICITY[0], RIGHT_OVER_LEFT[0] * EDV[0], RIGHT_WALL[0])


@dataclass(frozen=True)
class Anatomy:
    """Ventricles and the period of their beat, s."""

    shape: ParametricVentricles
    period: float


def draw_anatomy(seed: int) -> Anatomy:
    """The anatomy of this seed."""
    rng = np.random.default_rng(seed)

    def draw(mean: float, deviation: float) -> float:
        return mean + deviation * float(np.clip(rng.standard_normal(), -FURTHEST, FURTHEST))

    edv = draw(*EDV)
    right = edv * draw(*RIGHT_OVER_LEFT)
    shape = ParametricVentricles(edv, draw(*WALL), draw(*SPHERICITY), right, draw(*RIGHT_WALL))
    return Anatomy(shape, draw(*PERIOD))
