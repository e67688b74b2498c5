"""The closed surface of a segmented wall, open cavities cut at the base, with the name of each triangle.

Marching cubes (Lewiner et al. 2003, doi 10.1080/10867651.2003.10487582; the code is scikit-image's) on the points up to
the plane of the base, above which one more layer says "outside": so the base is flat, and its triangles are those that
reach into that layer. Without them the wall's surface falls into three pieces: both endocardia and the epicardium.
"""

import numpy as np
from scipy.ndimage import map_coordinates
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import euler_characteristic, neighbours
from heartfit.segmentation.labels import Segmentation
from heartfit.segmentation.wall import Levels, Shaping, levels_of

OUTSIDE = 1e3
"""In voxels; the larger, the nearer the lid lies to the plane of the base."""

NEAREST = 0.05
"""How near to a point the surface may cross, in voxels; nearer ones make slivers."""

SHAPING = Shaping()


def surface_of(segmentation: Segmentation, shaping: Shaping = SHAPING) -> LabelledSurface:
    """The wall's surface, coordinates of the scanner in m.

    Raises InputError, in one line, for slices that cannot be used, and where the surfaces of cavities and outside meet.
    """
    levels = levels_of(segmentation, shaping)
    places, triangles = _marched(levels.wall / shaping.spacing)
    top = levels.wall.shape[0] - 1
    lid = (places[triangles, 2] > top).any(axis=1)
    places[:, 2] = np.minimum(places[:, 2], top)
    pieces = _pieces(triangles[~lid])
    labels = np.full(len(triangles), "base", dtype="<U8")
    labels[~lid] = _named(levels, places, triangles[~lid], pieces)
    points = levels.box.points(places)
    _require_no_tunnel(triangles)
    outwards = enclosed_volume(points, triangles) > 0.0
    return LabelledSurface(points, triangles if outwards else triangles[:, ::-1], labels)


def _require_no_tunnel(triangles: Integers) -> None:
    tunnels = 1 - euler_characteristic(triangles) // 2
    if tunnels:
        raise InputError(
            f"segmentation: {tunnels} tunnels go through the wall; expected none: fill what the parts enclose, or "
            "segment thinner slices"
        )


def _marched(field: Floats) -> tuple[Floats, Integers]:
    """Places (n,3) as indices u, v, h and triangles (k,3) where a function (h,v,u) in voxels is zero."""
    from skimage.measure import marching_cubes

    apart = np.where(field < 0.0, -1.0, 1.0) * np.maximum(np.abs(field), NEAREST)
    padded = np.pad(apart, ((0, 1), (0, 0), (0, 0)), constant_values=OUTSIDE)
    places, triangles, _, _ = marching_cubes(padded, 0.0, allow_degenerate=False)  # type: ignore[no-untyped-call]
    return places[:, ::-1].astype(float), triangles.astype(np.int64)


def _pieces(triangles: Integers) -> Integers:
    """The number (k,) of the connected piece that each triangle belongs to."""
    pairs, count = neighbours(triangles), len(triangles)
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count))
    pieces: Integers = connected_components(graph, directed=False)[1]
    return pieces


def _named(levels: Levels, places: Floats, triangles: Integers, pieces: Integers) -> Names:
    """Names (k,) by the function that is zero on a piece; raises InputError unless each has one piece."""
    fields = {"lv_endo": levels.left, "rv_endo": levels.right, "epi": levels.outside}
    sampled = np.array([map_coordinates(field, places.T[::-1], order=1) for field in fields.values()])
    found = [
        list(fields)[int(np.abs(sampled[:, np.unique(triangles[pieces == piece])]).mean(axis=1).argmin())]
        for piece in range(int(pieces.max()) + 1)
    ]
    for name in fields:
        if found.count(name) != 1:
            raise InputError(
                f"segmentation: the surface of {name} has {found.count(name)} pieces; expected one of each, "
                "apart: close holes in the wall and take stray voxels out"
            )
    return np.array(found)[pieces]
