r"""What the observations owe to parameters that are not estimated.

A parameter p_j that is held at its mean, though it scatters with the standard deviation s_j of its logarithm, moves
the observations by what the calibration cannot explain; to first order it is noise of the model,

.. math:: R_{fixed} = \sum_j s_j^2\, \frac{\partial Z}{\partial \ln p_j}
          \Big(\frac{\partial Z}{\partial \ln p_j}\Big)^T .
"""

import numpy as np


def covariance_of_fixed(slopes: np.ndarray, sds: np.ndarray) -> np.ndarray:
    """R_fixed (m, m) from the slopes dZ/dln p_j (k, m) and the standard deviations s_j (k,); added to that of images.

    With no parameter held fixed it is zero. Raises ValueError for shapes that do not agree and for what is not finite.
    """
    if slopes.ndim != 2 or sds.shape != (len(slopes),):
        raise ValueError(f"fixed: slopes {slopes.shape}, deviations {sds.shape}; expected (k, m) and (k,)")
    scaled = slopes * sds[:, None]
    if not np.isfinite(scaled).all():
        raise ValueError("fixed: a slope or a deviation is not finite; expected numbers: did a beat fail?")
    return scaled.T @ scaled
