"""Grids of points, sewn into one closed surface where they meet."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import orient

NANOMETRE = 1e-9


@dataclass(frozen=True, eq=False)
class Seams:
    """Which points of the grids are the nodes (n,), and the triangles (k,3) between these with their names (k,).

    They hold for all grids that meet at the same points, whatever their shape.
    """

    nodes: Integers
    triangles: Integers
    labels: Names

    @classmethod
    def of(cls, names: Sequence[str], grids: Sequence[Floats]) -> "Seams":
        """The seams of grids (i,j,3) m with these names, joined where points coincide to a nanometre."""
        points = _stacked(grids)
        rounded = np.round(points / NANOMETRE)
        _, nodes, merged = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
        start = np.cumsum([0] + [grid.shape[0] * grid.shape[1] for grid in grids])
        triangles = [_grid_triangles(*grid.shape[:2]) + s for grid, s in zip(grids, start[:-1], strict=True)]
        labels = np.repeat(names, [len(part) for part in triangles])
        joined = merged.reshape(-1)[np.concatenate(triangles)]
        whole = (joined != np.roll(joined, 1, axis=1)).all(axis=1)
        oriented = orient(joined[whole].astype(np.int64))
        outwards = enclosed_volume(points[nodes], oriented) > 0.0
        return cls(nodes, oriented if outwards else oriented[:, ::-1], labels[whole])

    def points(self, grids: Sequence[Floats]) -> Floats:
        """The nodes' places (n,3) m on these grids."""
        return _stacked(grids)[self.nodes]

    def surface(self, grids: Sequence[Floats]) -> LabelledSurface:
        """The closed surface of these grids."""
        return LabelledSurface(self.points(grids), self.triangles, self.labels)


def _stacked(grids: Sequence[Floats]) -> Floats:
    return np.concatenate([grid.reshape(-1, 3) for grid in grids])


def _grid_triangles(rows: int, columns: int) -> Integers:
    node = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
