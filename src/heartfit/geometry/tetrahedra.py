"""Reproducible tetrahedral filling of a closed surface: one mesh for one surface and seed.

The mesher is fTetWild (Hu et al. 2020, doi 10.1145/3386569.3392385). It inserts the triangles in an order that it
shuffles with a number from the C++ library's random device, and offers no way to seed it; see
docs/decisions/geometry.md. Its second generator starts from a constant, once in a process. So each mesh is
made in a process of its own, `python -m heartfit.geometry.tetrahedra`, in which the random device returns the seed: the
first bytes of the one function of libstdc++ that draws the number are replaced, in the memory of this process alone, by
`return seed`. It runs in one thread. The input is rounded, because two processors agree on a surface only to the last
digit but one, and the mesher would turn that difference into another mesh.
"""

import ctypes
import io
import mmap
import os
import platform
import struct
import subprocess
import sys
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.one_thread import limit_other_libraries, limit_threading_blocks, living_threads
from heartfit.geometry.surface import LabelledSurface

Array = Floats | Integers
MODULE = "heartfit.geometry.tetrahedra"
DIGITS = 8
"""Decimals of a coordinate in units of about the size of the surface: 2 nm of a heart."""

DRAW_SYMBOL = "_ZNSt13random_device9_M_getvalEv"
"""Symbol of std::random_device::_M_getval() in libstdc++."""

SUPPORTED_PLATFORM = ("Linux", "x86_64")
RETURN_SEED = bytes.fromhex("f30f1efa b8") + b"%b" + bytes.fromhex("c3")  # endbr64; mov eax, seed; ret
WRITABLE, EXECUTABLE = mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC, mmap.PROT_READ | mmap.PROT_EXEC


def seed_random_device(library: str, seed: int) -> bool:
    """Make the random device of a shared library return the seed, 0 to 2^32 - 1; return True on success.

    On a system other than Linux on x86-64 it changes nothing and reports the reason on the standard error.
    """
    if (platform.system(), platform.machine()) != SUPPORTED_PLATFORM:
        return _warn_unseeded(f"this is {platform.system()} on {platform.machine()}")
    address = ctypes.cast(getattr(ctypes.CDLL(library), DRAW_SYMBOL), ctypes.c_void_p).value or 0
    if not _protect(address, WRITABLE):
        return _warn_unseeded("the system lets no program change its own code")
    code = RETURN_SEED % struct.pack("<I", seed)
    ctypes.memmove(address, code, len(code))
    return _protect(address, EXECUTABLE)


def _protect(address: int, allowed: int) -> bool:
    """Set the access to the memory page that holds the address, and to the next; return True on success."""
    page = address - address % mmap.PAGESIZE
    change = ctypes.CDLL(None).mprotect
    change.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
    return bool(change(page, 2 * mmap.PAGESIZE, allowed) == 0)


def _warn_unseeded(reason: str) -> bool:
    """Report on the standard error that meshes are not reproducible; return False."""
    sys.stderr.write(f"mesher: not seeded, a second mesh will differ from this one: {reason}\n")
    return False


def _limit_threads(library: str) -> None:
    """Limit the mesher to one thread; report on the standard error where this library has no such limit."""
    if not limit_threading_blocks(library):
        sys.stderr.write("mesher: not in one thread, a second mesh may differ from this one\n")


def _require_no_new_thread(before: int) -> None:
    """Raise RuntimeError if the process has more threads than before the meshing, which may decide about the mesh."""
    started = living_threads() - before
    if started > 0:
        raise RuntimeError(
            f"{started} more threads have meshed, so that another run may give another mesh; expected one thread in all"
        )


def tetrahedralise(
    surface: LabelledSurface, edge_length: float, tolerance: float, seed: int
) -> tuple[Floats, Integers]:
    """Return points (p, 3) [m] and positively oriented tetrahedra (t, 4) of the inside.

    edge_length: target edge length [m]; tolerance: largest distance [m] of the boundary from the surface; seed: another
    one gives another mesh of the same quality. Raises ChildProcessError if the mesher fails.
    """
    size = surface.diagonal()
    scale = 2.0 ** np.ceil(np.log2(size))  # a power of two, so that scaling is exact
    numbers = np.array([edge_length / size, tolerance / size, seed])
    arrays = (_round(surface.points / scale), surface.triangles, _round(numbers))
    points, tets = _unpack(_run_in_subprocess(_pack(*arrays)), 2)
    return points * scale, _orient_positively(points, tets)


def _round(values: Floats) -> Floats:
    return np.round(values, DIGITS) + 0.0  # + 0.0 replaces -0.0


def _run_in_subprocess(request: bytes) -> bytes:
    with TemporaryDirectory() as scratch:  # the mesher writes files into its working directory
        command = [sys.executable, "-m", MODULE, scratch]
        process = subprocess.run(command, input=request, capture_output=True, check=False)
    log = process.stderr.decode(errors="replace")
    if process.returncode:
        raise ChildProcessError(f"the mesher ended with {process.returncode}: {log[-500:]}")
    sys.stderr.write(log)
    return process.stdout


def _orient_positively(points: Floats, tets: Integers) -> Integers:
    a, b, c, d = points[tets.T]
    negative = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) < 0.0
    tets[negative] = tets[negative][:, [0, 2, 1, 3]]
    return tets


def _pack(*arrays: Array) -> bytes:
    stream = io.BytesIO()
    for array in arrays:
        np.save(stream, array, allow_pickle=False)
    return stream.getvalue()


def _unpack(packed: bytes, count: int) -> list[Any]:
    stream = io.BytesIO(packed)
    return [np.load(stream, allow_pickle=False) for _ in range(count)]


def _serve_request(scratch: str) -> None:
    """Read surface and sizes from the standard input and write the mesh to the standard output."""
    points, triangles, numbers = _unpack(sys.stdin.buffer.read(), 3)
    with os.fdopen(os.dup(1), "wb") as output:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # compiled code prints to standard output, too
        os.chdir(scratch)
        output.write(_pack(*_mesh_inside(points, triangles, *numbers)))


def _mesh_inside(
    points: Array, triangles: Array, edge_length: float, tolerance: float, seed: float
) -> tuple[Array, Array]:
    limit_other_libraries()
    import wildmeshing.wildmeshing as engine  # only in this subprocess, whose random device is replaced

    _limit_threads(engine.__file__)
    seed_random_device(engine.__file__, int(seed))
    mesher = engine.Tetrahedralizer(epsilon=tolerance, edge_length_r=edge_length, coarsen=True, max_threads=1)
    mesher.set_log_level(6)
    mesher.set_mesh(points, triangles.astype(np.int32))
    threads = living_threads()
    mesher.tetrahedralize()
    _require_no_new_thread(threads)
    vertices, tets, _ = mesher.get_tet_mesh(manifold_surface=True)
    return vertices, tets.astype(np.int64)


if __name__ == "__main__":
    _serve_request(sys.argv[1])
