"""The array types of the whole geometry: float64 coordinates in metres and int64 connectivities."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Names = NDArray[np.str_]
