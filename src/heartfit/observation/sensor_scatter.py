"""The parameters of the image sensors, learnt from sequences whose truth is known.

Where a noise model takes what images do as noise about a bias, the sensors take it as mechanisms of the measurement:
their scatter over the sequences is the prior of shrinkage, smoothing and delay.
"""

from collections.abc import Sequence

import numpy as np

from heartfit.errors import InputError
from heartfit.observation.pair import Pair
from heartfit.observation.scatter import Scatter
from heartfit.observation.sensors import fit_sensors


def sensor_scatter(pairs: Sequence[Pair]) -> Scatter:
    """Mean and covariance of the fitted shrinkage (1), smoothing (s) and delay (s), one fit for each pair.

    The true volume is taken at equidistant times, as many as there are frames. Smoothing is bounded by zero, so none
    at all is found as a few milliseconds where frames are noisy. Raises InputError for fewer than two pairs.
    """
    if len(pairs) < 2:
        raise InputError(f"sensors: {len(pairs)} sequences; expected two or more: simulate and register more")
    fits = [_fit(pair) for pair in pairs]
    return Scatter.of(tuple(fits[0]), np.array([list(fit.values()) for fit in fits]))


def _fit(pair: Pair) -> dict[str, float]:
    true, measured = (reading.curves["lv_volume"] for reading in (pair.true, pair.measured))
    return fit_sensors(true.resampled(true.times.size), measured)
