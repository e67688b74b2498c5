"""Array types: float64 values, int64 connectivities, text labels.

Coordinates are in metres. Symmetric tensors are six-vectors in the order 11, 22, 33, 12, 13, 23 (``ROW``, ``COLUMN``).
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Names = NDArray[np.str_]

ROW = np.array([0, 1, 2, 0, 0, 1])
COLUMN = np.array([0, 1, 2, 1, 2, 2])
