"""Numbers of the 17 segments of the American Heart Association, and territories of arteries and conduction branches.

A territory is the part of the left ventricular wall that one coronary artery, or one branch of the conduction system,
supplies. On the bull's-eye of 17 segments of equal weight it grows around the ventricle from its middle, from base to
apex at once. The apex belongs to the anterior septum, around which the left anterior descending artery reaches it. A
territory centred at 60, 180 or 300 degrees first fills the seven, five or five segments that the standard assigns to
the left anterior descending, the circumflex or the right coronary artery.

References
----------
Cerqueira MD et al. 2002, doi 10.1161/hc0402.102975.
"""

import numpy as np

from heartfit.core.arrays import Floats

RIGHT_VENTRICLE = 0
APEX = 17
REGIONS = APEX + 1
"""Number of regions: the segments and the right ventricular free wall."""

BASAL = np.array([2, 1, 6, 5, 4, 3])
APICAL = np.array([14, 13, 16, 15])
"""Segments in turn from the middle of the septum towards anterior; mid segments have the basal numbers plus 6."""

ACTIVATION_ORDER = [9, 8, 14, 7, 15, 10, 13, 17, 16, 11, 12, 1, 2, 3, 4, 6, 5]
"""Segments in the order of their activation in health, septum first and lateral base last."""

BORDER = np.deg2rad(45.0)
"""Width [rad] of the border zone in which a territory fades."""


def territory_weights(angle: float, share: float) -> Floats:
    """Return the weight (18,), 0 to 1, of each region in a territory that is this ``share`` of the left ventricle.

    ``angle`` [rad] of its middle, from the middle of the septum towards anterior; the right ventricle has weight 0.
    """
    distance = np.abs(np.angle(np.exp(1j * (_segment_angles() - angle))))
    weights = np.zeros(REGIONS)
    weights[1:] = np.clip((_reach(distance, share) - distance) / BORDER, 0.0, 1.0)
    return weights


def _segment_angles() -> Floats:
    """Angles (17,) [rad] of the middles of the segments."""
    angles = np.full(APEX, np.pi / 3.0)
    for level, segments in ((0, BASAL), (6, BASAL), (0, APICAL)):
        offset = 0.0 if segments is APICAL else 0.5
        angles[segments + level - 1] = 2.0 * np.pi * (np.arange(len(segments)) + offset) / len(segments)
    return angles


def _reach(distance: Floats, share: float) -> float:
    """Distance [rad] at which a territory ends that is the ``share`` of all segments."""
    ends = np.sort(np.concatenate([distance, distance + BORDER]))
    filled = np.clip((ends[:, None] - distance) / BORDER, 0.0, 1.0).mean(axis=1)
    return float(np.interp(share, filled, ends))
