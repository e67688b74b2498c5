"""The bull's-eye of the American Heart Association: how the segments of the left ventricle lie around its axis.

References
----------
Cerqueira MD et al. 2002, doi 10.1161/hc0402.102975.
"""

import numpy as np

RIGHT_VENTRICLE = 0
APEX = 17
REGIONS = APEX + 1
"""Segments and the right ventricular free wall."""

BASAL = np.array([2, 1, 6, 5, 4, 3])
APICAL = np.array([14, 13, 16, 15])
"""Sectors counted from the middle of the septum towards anterior; mid segments are 6 on from the basal ones."""
