"""Image trigger delay: frames whose time labels are late or early."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.core.periodic import apply_filter
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class ImageTriggerDelay(Sensor):
    r"""Volume curve delayed by d.

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
        meaning="delay of the images",
        off=0.0,
        low=-0.5,
        scale=0.03,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return apply_filter(
            times, values, period, lambda frequency: np.exp(-2j * np.pi * frequency * self.delay)
        )
