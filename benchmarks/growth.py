"""Growth of a cost with the size of the mesh."""

import numpy as np
from numpy.typing import ArrayLike


def growth(sizes: ArrayLike, costs: ArrayLike) -> float:
    """Exponent a of the cost c n^a by least squares of logarithms, from 2 or more values."""
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])
