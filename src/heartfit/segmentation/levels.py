"""A part of a stack of slices as a smooth function of space: negative inside, zero on its surface.

In a slice it is the signed distance from the outline; from slice to slice it is interpolated (shape-based
interpolation, Raya and Udupa 1990, doi 10.1109/42.52980). Below its last slice a part ends as a paraboloid, whose
area goes linearly to zero:

    phi(s) = phi_0 + r (1 - sqrt(1 - s / h)),    h = step A_0 / (A_1 - A_0), at most a step

with s the distance below the last slice, r the largest radius inside its outline there, A_0 and A_1 the areas of the
last slice and the one above.
"""

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import distance_transform_edt

from heartfit.geometry.arrays import Floats
from heartfit.segmentation.labels import Mask

SHORTEST_TIP = 0.25
"""Of a step; a shorter tip is noise of the areas."""


def slice_distances(mask: Mask, pixel: Floats) -> Floats:
    """Signed distance (k,j,i) m from the outline in each slice, negative inside; pixel (2,) m along j and i."""
    return np.array([_signed(slice_, pixel) for slice_ in mask])


def _signed(slice_: Mask, pixel: Floats) -> Floats:
    """The outline runs midway between the centres of two pixels that differ."""
    half = 0.5 * float(pixel.mean())
    outside = distance_transform_edt(~slice_, sampling=pixel)
    inside = distance_transform_edt(slice_, sampling=pixel)
    signed: Floats = np.where(slice_, half - inside, outside - half)
    return signed


def tip_length(areas: Floats, step: float) -> float:
    """How far below its last slice a part reaches, m; areas (2,) of the last slice and the one above."""
    last, above = areas
    share = last / (above - last) if above > last else 1.0
    return step * float(np.clip(share, SHORTEST_TIP, 1.0))


def interpolated(distances: Floats, areas: Floats, step: float, heights: Floats) -> Floats:
    """The function (h,j,i) m at heights (h,) m above the first of the slices, of which every one shows the part.

    distances (k,j,i) m, slices ``step`` m apart; above the last slice the part goes on unchanged.
    """
    places = step * np.arange(len(distances))
    between = PchipInterpolator(places, distances, axis=0)(np.clip(heights, 0.0, places[-1]))
    below = np.maximum(-heights, 0.0)[:, None, None]
    length, radius = tip_length(areas[:2], step), -float(distances[0].min())
    shrunk = radius * (1.0 - np.sqrt(np.clip(1.0 - below / length, 0.0, None)))
    levels: Floats = between + shrunk + np.maximum(below - length, 0.0)
    return levels
