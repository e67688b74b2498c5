"""Image trigger delay: frames that are labelled with another time than that of the heart they show."""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Sensor, mechanism
from heartfit.parameter import parameter, require_admissible
from heartfit.periodic import filtered


@mechanism
@dataclass(frozen=True)
class ImageTriggerDelay(Sensor):
    r"""Volume curve that seems late by d.

    .. math:: V'(t) = V(t - d), \qquad V'_k = e^{-2 \pi i k d / T} \, V_k

    for harmonic k of the period T. A trigger that fires after the R wave makes the curve seem early, d < 0; frames
    labelled with the end of their acquisition window make it seem late, d > 0.
    Source: ours.
    """

    measures = ("lv_volume", "rv_volume")
    delay: float = parameter(
        0.02,
        unit="s",
        symbol="d_V",
        meaning="by how much the images seem late",
        off=0.0,
        low=-0.5,
        scale=0.03,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return filtered(times, values, period, lambda frequency: np.exp(-2j * np.pi * frequency * self.delay))
