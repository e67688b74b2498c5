"""The surface of a beating wall, small enough for a page: rounded, as differences from phase to phase, deflated."""

import base64
import zlib
from typing import Any

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.report.record import CaseRecord
from heartfit.tables.activation_figure import nodal_means

QUANTUM = 1e-4
"""m: positions are rounded to it, and no eye sees less."""
OUTSIDE, INSIDE = ("epi",), ("lv_endo", "rv_endo", "base")


def surface(mesh: VentricularMesh) -> dict[str, Any]:
    """What does not move: of the outside and the inside, triangles, activation times of the nodes and segments.

    Segments are those of the tetrahedra behind the triangles.
    """
    return {name: _part(mesh, names) for name, names in (("outside", OUTSIDE), ("inside", INSIDE))}


def _part(mesh: VentricularMesh, names: tuple[str, ...]) -> dict[str, Any]:
    faces = np.vstack([mesh.surfaces[name] for name in names])
    nodes, corners = np.unique(faces, return_inverse=True)
    return {
        "triangles": packed(corners.reshape(faces.shape).T.astype("<i4")),
        "activation": packed(np.round(1e3 * nodal_means(mesh)[nodes]).astype("<i4")),
        "segment": packed(_segments_behind(mesh, faces).astype("<i4")),
    }


def _segments_behind(mesh: VentricularMesh, faces: Integers) -> Integers:
    """The segment (k,) of the tetrahedron of which each boundary triangle is a face."""
    opposite = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
    owners = {
        tuple(face): owner for owner, tet in enumerate(mesh.tets) for face in np.sort(tet[opposite]).tolist()
    }
    segments = np.asarray(mesh.segments)
    found: Integers = np.array([segments[owners[tuple(face)]] for face in np.sort(faces).tolist()])
    return found


def beating(mesh: VentricularMesh, positions: Floats) -> dict[str, str]:
    """The outside and the inside at positions (p, n, 3) m: (p, 3, n) quanta from the middle, first and differences.

    Axes: from septum to free wall, from anterior to posterior, from apex to base, those of the end-diastolic mesh.
    """
    axes = LeftVentricularAxes.of(mesh)
    frame = np.array([-axes.septal, -axes.anterior, axes.axis])
    middle = 0.5 * (mesh.points.max(axis=0) + mesh.points.min(axis=0))
    places = np.round((positions - middle) @ frame.T / QUANTUM).astype("<i4")
    return {
        name: packed(np.diff(places[:, _nodes(mesh, parts)].swapaxes(1, 2), axis=0, prepend=0))
        for name, parts in (("outside", OUTSIDE), ("inside", INSIDE))
    }


def _nodes(mesh: VentricularMesh, names: tuple[str, ...]) -> Integers:
    return np.unique(np.vstack([mesh.surfaces[name] for name in names]))


def packed(numbers: np.ndarray) -> str:
    """Little-endian integers of 32 bits in base 64, deflated."""
    return base64.b64encode(zlib.compress(numbers.astype("<i4").tobytes(), 9)).decode("ascii")


def unpacked(text: str) -> np.ndarray:
    """What :func:`packed` was given, flat."""
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), "<i4")


def viewed(case: CaseRecord) -> dict[str, Any]:
    """All that the viewer of a case is given: its measured and its calibrated motions, at the measured phases."""
    times = case.registered.times
    simulated = {
        f"calibrated, {name}": np.array([fit.motion.at(time) for time in times + fit.shift])
        for name, fit in case.fits.items()
        if fit.motion is not None
    }
    positions = {"measured": case.registered.positions, **simulated}
    return {
        "quantum_mm": 1e3 * QUANTUM,
        "period_ms": round(1e3 * case.registered.period, 1),
        "times_ms": np.round(1e3 * times, 1).tolist(),
        "surface": surface(case.mesh),
        "motions": {name: beating(case.mesh, each) for name, each in positions.items()},
    }
