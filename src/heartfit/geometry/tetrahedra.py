"""Fills a closed surface with tetrahedra, the same ones for the same surface and seed.

The mesher is fTetWild (Hu et al. 2020, doi 10.1145/3386569.3392385). It inserts the triangles in an order that it
shuffles with a number from the C++ library's random device, and offers no way to seed it; see
docs/decisions/021-same-mesh-twice.md. Its second generator starts from a constant, once in a process. So each mesh is
made in a process of its own, in which the random device gives the seed: `python -m heartfit.geometry.tetrahedra`. What
it is given is rounded: two processors agree on a surface to the last digit but one, and the mesher tells them apart.
"""

import io
import os
import subprocess
import sys
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.random_device import answer
from heartfit.geometry.surface import LabelledSurface

Array = Floats | Integers
MODULE = "heartfit.geometry.tetrahedra"
DIGITS = 8
"""Decimals of a coordinate whose unit is about the size of the surface: 2 nm of a heart."""


def tetrahedralise(
    surface: LabelledSurface, edge_length: float, tolerance: float, seed: int
) -> tuple[Floats, Integers]:
    """Points (p, 3) and positively oriented tetrahedra (t, 4) of the inside.

    edge_length: wished edge length in m; tolerance: how far in m the boundary may leave the surface; seed: another one
    gives another mesh of the same quality. Raises ChildProcessError if the mesher fails.
    """
    size = surface.diagonal()
    scale = 2.0 ** np.ceil(np.log2(size))  # a power of two: no digit is lost
    numbers = np.array([edge_length / size, tolerance / size, seed])
    asked = (_rounded(surface.points / scale), surface.triangles, _rounded(numbers))
    points, tets = _unpacked(_in_its_own_process(_packed(*asked)), 2)
    return points * scale, _positively_oriented(points, tets)


def _rounded(values: Floats) -> Floats:
    return np.round(values, DIGITS) + 0.0  # and no -0.0


def _in_its_own_process(asked: bytes) -> bytes:
    with TemporaryDirectory() as scratch:  # the mesher writes files where it stands
        command = [sys.executable, "-m", MODULE, scratch]
        done = subprocess.run(command, input=asked, capture_output=True, check=False)
    said = done.stderr.decode(errors="replace")
    if done.returncode:
        raise ChildProcessError(f"the mesher ended with {done.returncode}: {said[-500:]}")
    sys.stderr.write(said)
    return done.stdout


def _positively_oriented(points: Floats, tets: Integers) -> Integers:
    a, b, c, d = points[tets.T]
    negative = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) < 0.0
    tets[negative] = tets[negative][:, [0, 2, 1, 3]]
    return tets


def _packed(*arrays: Array) -> bytes:
    stream = io.BytesIO()
    for array in arrays:
        np.save(stream, array, allow_pickle=False)
    return stream.getvalue()


def _unpacked(packed: bytes, count: int) -> list[Any]:
    stream = io.BytesIO(packed)
    return [np.load(stream, allow_pickle=False) for _ in range(count)]


def _answer_once(scratch: str) -> None:
    """Read what is asked from the standard input and write the mesh to the standard output."""
    points, triangles, numbers = _unpacked(sys.stdin.buffer.read(), 3)
    with os.fdopen(os.dup(1), "wb") as output:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # compiled code prints there, too
        os.chdir(scratch)
        output.write(_packed(*_meshed(points, triangles, *numbers)))


def _meshed(
    points: Array, triangles: Array, edge_length: float, tolerance: float, seed: float
) -> tuple[Array, Array]:
    import wildmeshing.wildmeshing as engine  # only here, in a process that does nothing else

    answer(engine.__file__, int(seed))
    mesher = engine.Tetrahedralizer(epsilon=tolerance, edge_length_r=edge_length, coarsen=True, max_threads=1)
    mesher.set_log_level(6)
    mesher.set_mesh(points, triangles.astype(np.int32))
    mesher.tetrahedralize()
    found, tets, _ = mesher.get_tet_mesh(manifold_surface=True)
    return found, tets.astype(np.int64)


if __name__ == "__main__":
    _answer_once(sys.argv[1])
