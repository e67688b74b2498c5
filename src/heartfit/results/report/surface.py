"""Surfaces, motions and colour scales of the ventricles, packed for the viewer of the page."""

import base64
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex, to_rgb

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.territory import REGIONS
from heartfit.results.activation import nodal_means
from heartfit.results.report.record import CaseRecord

RIGHT_COLOUR = "#bbbbbb"
BASAL_COLOURS = ("#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#CC79A7")
"""Colours of Okabe and Ito by sector."""
RING_WHITENESS = {1: 0.0, 7: 0.35, 13: 0.6, 17: 0.8}
"""Share of white in the colours of a ring, by its first segment."""
STRAIN, DISTANCE, ISOCHRONE = 40.0, 15.0, 10.0
"""Ranges of strain [%] and distance [mm], and spacing of isochrones [ms]."""


def colour_scales(cases: Sequence[CaseRecord]) -> dict[str, dict[str, Any]]:
    """Return title, label, range and colours of each scale by name; all cases share them."""
    latest = max(1e3 * float(np.asarray(case.mesh.activation).max()) for case in cases)
    end = ISOCHRONE * np.ceil(latest / ISOCHRONE)
    return {
        "activation": {
            "title": "activation time",
            "label": "activation time (ms), one colour per 10 ms",
            **_colour_ramp("RdYlBu", 0.0, end, "vertex", steps=int(end / ISOCHRONE)),
        },
        "distance": {
            "title": "distance between left and right",
            "label": "distance between left and right (mm)",
            **_colour_ramp("cividis", 0.0, DISTANCE, "vertex"),
        },
        "strain": {
            "title": "stretch of the surface",
            "label": "stretch of the surface since end diastole (%), violet: shorter",
            **_colour_ramp("PuOr_r", -STRAIN, STRAIN, "vertex"),
        },
        "segment": {
            "title": "region of the wall",
            "label": "AHA segment: 0 right free wall (grey), 1 to 6 basal, paler towards the apex, 17",
            "low": 0, "high": REGIONS - 1, "mode": "cell", "colours": _colour_steps([RIGHT_COLOUR, *_segments()]),
        },
    }  # fmt: skip


def _colour_ramp(name: str, low: float, high: float, mode: str, steps: int = 0) -> dict[str, Any]:
    places = np.linspace(0.0, 1.0, steps or 11)
    colours = [to_hex(colour) for colour in colormaps[name](places)]
    scale = (
        _colour_steps(colours)
        if steps
        else [[round(float(x), 3), c] for x, c in zip(places, colours, strict=True)]
    )
    return {"low": low, "high": high, "mode": mode, "colours": scale}


def _colour_steps(colours: list[str]) -> list[list[Any]]:
    """Return constant colours over equal shares of the range."""
    edges = np.round(np.linspace(0.0, 1.0, len(colours) + 1), 4).tolist()
    return [[edge, colour] for place, colour in enumerate(colours) for edge in edges[place : place + 2]]


def _segments() -> list[str]:
    """Return the colours of segments 1 to 17; an apical sector has the colour of the sector above its middle."""
    sectors = [*range(6), *range(6), 0, 1, 3, 4, 0]
    white = [max(first for first in RING_WHITENESS if first <= segment) for segment in range(1, REGIONS)]
    return [_whiten(BASAL_COLOURS[s], RING_WHITENESS[first]) for s, first in zip(sectors, white, strict=True)]


def _whiten(colour: str, white: float) -> str:
    return to_hex(tuple(np.array(to_rgb(colour)) * (1.0 - white) + white))


QUANTUM = 1e-4
"""Resolution of positions [m]."""
OUTSIDE, INSIDE = ("epi",), ("lv_endo", "rv_endo", "base")


def packed_surface(mesh: VentricularMesh) -> dict[str, Any]:
    """Return triangles, activation times of the nodes and segments of the outside and the inside.

    Segments are those of the tetrahedra behind the triangles.
    """
    return {name: _part(mesh, names) for name, names in (("outside", OUTSIDE), ("inside", INSIDE))}


def _part(mesh: VentricularMesh, names: tuple[str, ...]) -> dict[str, Any]:
    faces = np.vstack([mesh.surfaces[name] for name in names])
    nodes, corners = np.unique(faces, return_inverse=True)
    return {
        "triangles": pack(corners.reshape(faces.shape).T.astype("<i4")),
        "activation": pack(np.round(1e3 * nodal_means(mesh)[nodes]).astype("<i4")),
        "segment": pack(_segments_behind(mesh, faces).astype("<i4")),
    }


def _segments_behind(mesh: VentricularMesh, faces: Integers) -> Integers:
    """Return the segment (k,) of the tetrahedron behind each boundary triangle."""
    opposite = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
    owners = {
        tuple(face): owner for owner, tet in enumerate(mesh.tets) for face in np.sort(tet[opposite]).tolist()
    }
    segments = np.asarray(mesh.segments)
    segments_of_faces: Integers = np.array(
        [segments[owners[tuple(face)]] for face in np.sort(faces).tolist()]
    )
    return segments_of_faces


def packed_positions(mesh: VentricularMesh, positions: Floats) -> dict[str, str]:
    """Return positions (p, n, 3) [m] of the outside and the inside as differences in time: (p, 3, n) quanta.

    Origin: middle of the end-diastolic mesh; axes: from septum to free wall, from anterior to posterior, from apex to
    base.
    """
    axes = LeftVentricularAxes.from_mesh(mesh)
    frame = np.array([-axes.septal, -axes.anterior, axes.axis])
    middle = 0.5 * (mesh.points.max(axis=0) + mesh.points.min(axis=0))
    places = np.round((positions - middle) @ frame.T / QUANTUM).astype("<i4")
    return {
        name: pack(np.diff(places[:, _nodes(mesh, parts)].swapaxes(1, 2), axis=0, prepend=0))
        for name, parts in (("outside", OUTSIDE), ("inside", INSIDE))
    }


def _nodes(mesh: VentricularMesh, names: tuple[str, ...]) -> Integers:
    return np.unique(np.vstack([mesh.surfaces[name] for name in names]))


def pack(numbers: np.ndarray) -> str:
    """Return 32-bit little-endian integers, deflated, in base 64."""
    return base64.b64encode(zlib.compress(numbers.astype("<i4").tobytes())).decode("ascii")


def unpack(text: str) -> np.ndarray:
    """Return the integers of :func:`pack`, flat."""
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), "<i4")


def viewer_data(case: CaseRecord) -> dict[str, Any]:
    """Return the data of the viewer: measured and calibrated motions of a case at the measured phases."""
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
        "surface": packed_surface(case.mesh),
        "motions": {name: packed_positions(case.mesh, motion) for name, motion in positions.items()},
    }
