"""The maximum of the benchmark's active stress and its time."""

import numpy as np

from heartfit.verification.arostica import active_stress
from heartfit.verification.check import Check

STEP = 5e-4
MAXIMUM, TIME = 118.106, 479.5
"""kPa and ms, from the benchmark's equation solved to ten digits; a test does so again."""

SOURCE = "Arostica et al. 2025"


def arostica_checks() -> list[Check]:
    """Maximum within 0.1 % and its time within a step."""
    times, stress = active_stress(STEP)
    largest, at = 1e-3 * float(stress.max()), 1e3 * float(times[np.argmax(stress)])
    return [
        Check("active stress: maximum, steps of 0.5 ms", largest, MAXIMUM, 0.118, "kPa", SOURCE),
        Check("active stress: time of the maximum", at, TIME, 0.5, "ms", SOURCE),
    ]
