"""Parts of the left ventricular wall that one coronary artery, or one branch of the conduction system, supplies.

On the bull's-eye of 17 segments of equal weight a territory grows from its middle on around the ventricle, base to apex
at once; the apex goes with the anterior septum, around which the left anterior descending artery reaches it. In the
middle of its three arteries' territories, at 60, 180 and 300 degrees, seven, five and five segments are filled first:
those that the standard assigns to the left anterior descending, the circumflex and the right coronary artery.

References
----------
Cerqueira MD et al. 2002, doi 10.1161/hc0402.102975.
"""

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.bullseye import APEX, APICAL, BASAL, REGIONS

BORDER = np.deg2rad(45.0)
"""Width of the border zone, in which a territory fades."""


def territory(angle: float, share: float) -> Floats:
    """How much (18,), 0 to 1, of each region belongs to a territory that is this ``share`` of the left ventricle.

    ``angle``, rad, of its middle, from the middle of the septum towards anterior; the right ventricle is spared.
    """
    away = np.abs(np.angle(np.exp(1j * (_angles() - angle))))
    result = np.zeros(REGIONS)
    result[1:] = np.clip((_reach(away, share) - away) / BORDER, 0.0, 1.0)
    return result


def _angles() -> Floats:
    """Angle (17,) of the middle of every segment."""
    result = np.full(APEX, np.pi / 3.0)
    for level, segments in ((0, BASAL), (6, BASAL), (0, APICAL)):
        offset = 0.0 if segments is APICAL else 0.5
        result[segments + level - 1] = 2.0 * np.pi * (np.arange(len(segments)) + offset) / len(segments)
    return result


def _reach(away: Floats, share: float) -> float:
    """Distance, rad, to which the territory reaches so that it is the ``share`` of all segments."""
    ends = np.sort(np.concatenate([away, away + BORDER]))
    filled = np.clip((ends[:, None] - away) / BORDER, 0.0, 1.0).mean(axis=1)
    return float(np.interp(share, filled, ends))
