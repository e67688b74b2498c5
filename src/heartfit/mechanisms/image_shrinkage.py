"""Image shrinkage: a registration that follows only part of the motion."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class ImageShrinkage(Sensor):
    r"""Volume curve of a registration that loses the fraction s of every excursion from its first frame.

    .. math:: V'(t) = V(0) - (1 - s)\,(V(0) - V(t)),

    with V(0) the volume in the frame of the trigger, to which all others are registered and which is therefore
    exact. A registration that favours smooth displacements underestimates them, s > 0; s < 0 is an
    overshoot, s = 1 no motion at all.
    Source: ours; the tracking errors behind it are 1.5 to 2.1 mm (Tobon-Gomez et al., Med Image Anal 2013,
    doi:10.1016/j.media.2013.03.008).
    """

    measures = ("lv_volume", "rv_volume")
    shrinkage: float = parameter(
        0.1,
        unit="1",
        symbol="s",
        meaning="fraction of the motion that is lost",
        off=0.0,
        low=-1.0,
        scale=0.08,
    )

    def __post_init__(self) -> None:
        require_admissible(self)
        if self.shrinkage >= 1.0:
            raise InputError(
                f"ImageShrinkage.shrinkage = {self.shrinkage:g}: expected less than 1, where no motion is left"
            )

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        first = np.interp(0.0, times, values, period=period)
        # this form is exact at s = 0
        return values + self.shrinkage * (first - values)
