r"""Strokes of both ventricles, which are equal unless a valve leaks or a wall between the sides has a hole.

Blood that one side pumps into its artery returns to the other one. A regurgitation passes its own ventricle twice, and
a septal defect makes the left ventricle pump more:

.. math:: \Delta = S_{LV} - S_{RV}, \qquad
          s^2 = (0.02\, V_{LV})^2 + (0.02\, V_{RV})^2 + (0.1\, S_{RV})^2 + (0.02\, V_{LV})^2 ,

with the noise of both volumes, the gain of right volumes and the balance of the sides; V are end-diastolic volumes.
"""

from dataclasses import dataclass
from math import hypot
from typing import Self

import numpy as np

from heartfit.discovery.sphere_model.free_parameters import RIGHT_SPHERE_PARAMETERS
from heartfit.discovery.sphere_model.recording import BALANCE_SD, Recording

FRAME_NOISE = 0.02
"""Noise of a stroke over the end-diastolic volume: two frames of a middle noise at either end."""
(GAIN_SD,) = (one.person for one in RIGHT_SPHERE_PARAMETERS if one.name == "right_gain")
CLEAR = 2.0
"""Standard deviations from which strokes differ."""


@dataclass(frozen=True)
class Strokes:
    """Volumes that the ventricles eject in a beat, and the standard deviation of their difference [m^3]."""

    left: float
    right: float
    sd: float

    @classmethod
    def from_recording(cls, recording: Recording) -> Self | None:
        """Return the strokes of a recording; None without a right volume."""
        if "rv_volume" not in recording.curves:
            return None
        (left, filled), (right, right_filled) = (
            (_stroke(recording, name), recording.end_diastolic_volume(name))
            for name in ("lv_volume", "rv_volume")
        )
        sd = hypot(FRAME_NOISE * filled, FRAME_NOISE * right_filled, GAIN_SD * right, BALANCE_SD * filled)
        return cls(left, right, sd)

    @property
    def difference(self) -> float:
        """Left stroke less the right one [m^3]."""
        return self.left - self.right

    @property
    def differ(self) -> bool:
        """True if the difference exceeds what the volumes err by."""
        return abs(self.difference) > CLEAR * self.sd


def _stroke(recording: Recording, name: str) -> float:
    """Difference of the means of the largest and the smallest tenth of the volumes [m^3]."""
    values = np.sort(recording.curves[name].values)
    tenth = max(1, values.size // 10)
    return float(values[-tenth:].mean() - values[:tenth].mean())
