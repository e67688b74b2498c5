"""The mesher in its own process: one mesh for one surface and seed, without output."""

import os
import platform
import re
import subprocess
import sys
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry import tetrahedra
from heartfit.geometry.surface import LabelledSurface, triangle_normals
from heartfit.geometry.tetrahedra import seed_random_device, tetrahedralise

SEEDABLE = (platform.system(), platform.machine()) == ("Linux", "x86_64")


@pytest.fixture(scope="module")
def pebble() -> LabelledSurface:
    """The convex hull of 40 points of a sphere: enough triangles for their order to matter."""
    points = np.random.default_rng(0).normal(size=(40, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    triangles = ConvexHull(points).simplices.astype(np.int64)
    inward = (triangle_normals(points, triangles) * points[triangles].mean(axis=1)).sum(axis=1) < 0.0
    triangles[inward] = triangles[inward][:, [0, 2, 1]]
    return LabelledSurface(points, triangles, np.full(len(triangles), "epi"))


@pytest.fixture(scope="module")
def meshed(pebble: LabelledSurface) -> tuple[Floats, Integers]:
    return tetrahedralise(pebble, 1.5, 0.5, 0)


@pytest.mark.skipif(not SEEDABLE, reason="the random device can be set on Linux with x86-64 only")
def test_the_same_seed_gives_the_same_mesh_and_another_one_another(
    pebble: LabelledSurface, meshed: tuple[Floats, Integers], capfd: pytest.CaptureFixture[str]
) -> None:
    one, again, other = meshed, *(tetrahedralise(pebble, 1.5, 0.5, seed) for seed in (0, 1))
    for array, repeated in zip(one, again, strict=True):
        np.testing.assert_array_equal(array, repeated)
    assert one[0].shape != other[0].shape or not np.array_equal(one[0], other[0])
    assert capfd.readouterr() == ("", "")


@pytest.mark.skipif(not SEEDABLE, reason="the random device can be set on Linux with x86-64 only")
def test_round_off_of_another_processor_leaves_the_mesh_unchanged(
    pebble: LabelledSurface, meshed: tuple[Floats, Integers]
) -> None:
    nudged = LabelledSurface(np.nextafter(pebble.points, 9.0), pebble.triangles, pebble.labels)
    other = tetrahedralise(nudged, 1.5, 0.5, 0)
    for array, repeated in zip(meshed, other, strict=True):
        np.testing.assert_array_equal(array, repeated)


@pytest.mark.skipif(not SEEDABLE, reason="threads are counted on Linux only")
def test_threads_that_mesh_in_spite_of_the_limit_are_refused(pebble: LabelledSurface) -> None:
    """Without its limit the mesher starts one thread for each further processor, and its mesh depends on their luck."""
    if len(os.sched_getaffinity(0)) == 1:
        pytest.skip("with one processor the mesher starts no further thread")
    program = (
        "import sys; from heartfit.geometry import tetrahedra\n"
        "tetrahedra.limit_threading_blocks = lambda library: True; tetrahedra._serve_request(sys.argv[1])"
    )
    request = tetrahedra._pack(pebble.points, pebble.triangles, np.array([1.5, 0.5, 0.0]))
    with TemporaryDirectory() as scratch:
        command = [sys.executable, "-c", program, scratch]
        process = subprocess.run(command, input=request, capture_output=True, check=False)
    assert process.returncode == 1
    assert not process.stdout
    assert re.search(rb"\d+ more threads have meshed.*expected one thread", process.stderr)


def test_a_library_without_the_limit_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    tetrahedra._limit_threads("libm.so.6")
    assert "not in one thread" in capsys.readouterr().err


def test_a_crash_of_the_mesher_is_reported_with_its_log(
    pebble: LabelledSurface, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tetrahedra, "MODULE", "heartfit.no_such_module")
    with pytest.raises(ChildProcessError, match=r"\b1\b.*no_such_module"):
        tetrahedralise(pebble, 1.5, 0.5, 0)


def test_a_random_device_that_cannot_be_set_is_unchanged_and_reported(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "abacus")
    assert not seed_random_device("no library is opened", 0)
    assert "Linux on abacus" in capsys.readouterr().err


@pytest.mark.skipif(not SEEDABLE, reason="the random device can be set on Linux with x86-64 only")
def test_the_random_device_gives_the_seed() -> None:
    """Runs in a separate process: the seeded device keeps its values for the whole process."""
    program = (
        "import ctypes; from heartfit.geometry.tetrahedra import DRAW_SYMBOL, seed_random_device\n"
        "draw = getattr(ctypes.CDLL('libstdc++.so.6'), DRAW_SYMBOL); draw.restype = ctypes.c_uint32\n"
        "assert seed_random_device('libstdc++.so.6', 4000000000); print(draw(0), draw(0))"
    )
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert process.stdout.split() == ["4000000000"] * 2
