"""Healthy adults drawn from published normal values: shape by sex, and a muscle that gives a normal beat.

Volumes of both ventricles and thickness of the wall are drawn about the means of healthy men and women. Parameters are
drawn about the standard heart with the spread of healthy adults, and a heart is kept if ejection fraction,
end-systolic volume and pressures of its beat are normal. No patient and no published estimate enters the draw.

References
----------
Hudsmith LE et al. 2005, J Cardiovasc Magn Reson 7:775: volumes of 63 men and 45 women. Kawel N et al. 2012, Circ
Cardiovasc Imaging 5:500: thickness of the mid-cavity wall of 131 men and 169 women free of cardiac disease.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from heartfit.calibration.plausible import Limit
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import PressureFeatures, cavity_indices, observe
from heartfit.synthetic.volunteer import (
    ESTIMATED,
    ESTIMATED_SPREAD,
    PERIOD,
    RIGHT_WALL,
    SPHERICITY,
    TRUNCATION,
    Anatomy,
)

Sex = Literal["man", "woman"]
SEXES: tuple[Sex, ...] = get_args(Sex)
LEFT_VOLUME = {"man": (160e-6, 29e-6), "woman": (135e-6, 26e-6)}
RIGHT_VOLUME = {"man": (190e-6, 33e-6), "woman": (148e-6, 35e-6)}
WALL = {"man": (6.3e-3, 1.1e-3), "woman": (5.3e-3, 0.9e-3)}
"""Published mean and standard deviation of end-diastolic volumes [m^3] and wall thickness [m]."""
CORRELATION = 0.8
"""Correlation of left and right volumes; an assumption: both ventricles eject the same volume."""
THINNEST = 4.5e-3
"""Least thickness of a drawn wall [m]; thinner ones are less than half an element of the meshes."""
MILLILITRES, TENTHS_OF_MILLIMETRES = 6, 4
"""Decimals of rounded volumes [m^3] and lengths [m]."""


def _midway(means: Mapping[str, tuple[float, float]]) -> float:
    return float(np.mean([mean for mean, _ in means.values()]))


@dataclass(frozen=True)
class NormalAdult:
    """A drawn adult: sex, anatomy, and the estimated parameters as ratios to the standard heart's."""

    sex: Sex
    anatomy: Anatomy
    ratios: Mapping[str, float]


MEAN_ADULT = Anatomy(
    ParametricVentricles(
        edv=_midway(LEFT_VOLUME),
        wall_thickness=_midway(WALL),
        sphericity=SPHERICITY[0],
        rv_edv=_midway(RIGHT_VOLUME),
        rv_wall_thickness=RIGHT_WALL[0],
    ),
    PERIOD[0],
)
"""Adult midway between the mean man and the mean woman; sphericity, right wall and period are the volunteers' means."""


def draw_adult(seed: int) -> NormalAdult:
    """Draw the adult of this seed, in the rounded numbers of a table of cases.

    A deviate beyond TRUNCATION standard deviations is set to it, a wall below THINNEST to that.
    """
    rng = np.random.default_rng(seed)

    def deviate() -> float:
        return float(np.clip(rng.standard_normal(), -TRUNCATION, TRUNCATION))

    def draw(mean: float, deviation: float, digits: int) -> float:
        return round(mean + deviation * deviate(), digits)

    sex = SEXES[int(rng.integers(len(SEXES)))]
    size = deviate()
    shared = CORRELATION * size + np.sqrt(1.0 - CORRELATION**2) * deviate()
    left, right = (
        round(mean + deviation * share, MILLILITRES)
        for (mean, deviation), share in ((LEFT_VOLUME[sex], size), (RIGHT_VOLUME[sex], shared))
    )
    wall = max(draw(*WALL[sex], TENTHS_OF_MILLIMETRES), THINNEST)
    sphericity, right_wall = draw(*SPHERICITY, 2), draw(*RIGHT_WALL, TENTHS_OF_MILLIMETRES)
    shape = ParametricVentricles(left, wall, sphericity, right, right_wall)
    period = draw(*PERIOD, 2)
    ratios = {name: round(float(np.exp(ESTIMATED_SPREAD * deviate())), 3) for name in ESTIMATED}
    return NormalAdult(sex, Anatomy(shape, period), ratios)


def abnormal(beat: Beat, limits: Sequence[Limit]) -> list[str]:
    """Names of the limits that a completed beat of the left ventricle violates."""
    curves = beat_curves(beat)
    indices = {**cavity_indices(curves), **observe(curves, {"lv_pressure": PressureFeatures()})}
    return [limit.quantity for limit in limits if not limit.holds(indices[limit.quantity])]
