"""Kernels are compiled once, for arrays in the memory layout of the study."""

import importlib
import inspect
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numba.core.caching import _CacheLocator
from numba.core.dispatcher import Dispatcher

import heartfit
from heartfit.core import kernel_cache
from heartfit.geometry.cube import cube
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.imaging.raster import paint_inside, paint_wall, sample_fields
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.roles.laws import outside_pressure
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.kernels import compile_kernels
from heartfit.synthetic.scanner import Scanner

IMAGE_KERNELS = (paint_wall, paint_inside, sample_fields)


def test_the_beat_that_compiles_them_is_a_whole_one():
    beat = compile_kernels()
    assert beat.completed, beat.reason
    assert abs(beat.volume["lv"][0] - beat.volume["lv"]).max() > 1e-8, "the cube contracts"


def test_the_mesh_has_the_memory_layout_of_meshes_read_from_files():
    block = cube(2, 0.02)
    assert all(array.flags.c_contiguous for array in (block.points, block.tets, block.fibres)), (
        "or numba compiles again"
    )


def test_images_of_a_mesh_from_a_file_need_no_other_kernels(ventricle: VentricularMesh, tmp_path: Path):
    compile_kernels()
    signatures = [list(kernel.signatures) for kernel in IMAGE_KERNELS]
    assert all(signatures)
    write_mesh(tmp_path / "mesh.vtu", ventricle)
    mesh = read_mesh(tmp_path / "mesh.vtu")
    still = Motion(0.1 * np.arange(8), 0.8, np.tile(mesh.points, (8, 1, 1)))
    scanner = Scanner(frames=8, voxel=6e-3, slice_thickness=6e-3, subvoxel=6e-3, subframes=1)
    track(image_beat(mesh, still, scanner, 0), mesh, FreeForm(levels=((2, 1), (1, 1))))
    assert [list(kernel.signatures) for kernel in IMAGE_KERNELS] == signatures


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A copy of the sources of this package."""
    source, copy = Path(heartfit.__file__).parent, tmp_path / "heartfit"
    shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def hand_kernels_over(package: Path) -> None:
    """Give the copied ``package`` the kernels that are compiled already: its sources are of the same dates."""
    original = Path(heartfit.__file__).parent
    kept, copy = kernel_cache.kernel_folder(original), kernel_cache.kernel_folder(package)
    assert copy.name == kept.name
    for room in {file.parent for file in kernel_cache.kernel_sources(original)}:
        names = (
            _CacheLocator.get_suitable_cache_subpath(str(folder / "any.py"))
            for folder in (room, package / room.relative_to(original))
        )
        source, target = (folder / name for folder, name in zip((kept, copy), names, strict=True))
        if source.exists():
            shutil.copytree(source, target)


def source_in(package: Path, function: Callable) -> Path:
    """The file of the copied ``package`` in which ``function`` is defined."""
    return package / Path(inspect.getfile(function)).relative_to(Path(heartfit.__file__).parent)


@pytest.mark.long
def test_an_edit_of_an_inlined_function_changes_the_beat(package: Path) -> None:
    """500 Pa more outside the ventricles; the kernels of the first beat are kept."""
    used = (Heart, Pericardium, Sphere, Numerics, simulate_spheres)
    script = "\n".join(
        (
            *(f"from {name.__module__} import {name.__name__}" for name in used),
            "numerics = Numerics(time_step=0.02, max_beats=1, drift=0.0)",
            "beat = simulate_spheres(Heart() + Pericardium(), [Sphere.from_volumes(80e-6, 130e-6)], numerics)",
            "print(beat.reason or beat.volume['lv'].max())",
        )
    )

    def largest_volume() -> float:
        return float(run_python(script, PYTHONPATH=str(package.parent)))

    hand_kernels_over(package)
    before = largest_volume()
    file, function = source_in(package, outside_pressure.py_func), inspect.getsource(outside_pressure.py_func)
    edited = re.sub(r"return (.+)", r"return (\1)[0] + 500.0, (\1)[1]", function)
    assert edited != function
    file.write_text(file.read_text().replace(function, edited))
    assert largest_volume() < before - 1e-6


def test_every_compiled_function_of_the_package_is_in_a_known_source() -> None:
    package = Path(heartfit.__file__).parent
    for module in pkgutil.walk_packages(heartfit.__path__, "heartfit."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    modules = [module for name, module in sys.modules.items() if name.startswith("heartfit.")]
    kernels = {
        value for module in modules for value in vars(module).values() if isinstance(value, Dispatcher)
    }
    files = {Path(inspect.getfile(kernel.py_func)) for kernel in kernels}
    assert len(files) > 5
    assert files <= set(kernel_cache.kernel_sources(package))


def test_sources_of_kernels_are_those_that_import_numba_and_what_they_import(tmp_path: Path) -> None:
    """All ways of importing are recognised; an edit of another file keeps the kernels."""
    sources = {
        "a/kernel.py": "import numpy as np, numba as nb\nfrom room import b\n@nb.jit\ndef f(): return b.g()",
        "other.py": "    from numba import njit as compiled",
        "b/__init__.py": "from room.b.inner import (  # one, two\n    g,  # in, lined\n    h,\n)",
        "b/inner.py": "import room.constants as at, \\\n room.more",
        "constants.py": "",
        "more.py": "import elsewhere.free",
        "free.py": "'numba is fast'",
        "a/__init__.py": "from room.a.kernel import f",
    }
    package = tmp_path / "room"
    for name, text in sources.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    names = {file.relative_to(package).as_posix() for file in kernel_cache.kernel_sources(package)}
    assert names == sources.keys() - {"free.py", "a/__init__.py"}
    before = kernel_cache.kernel_folder(package)
    date = (package / "more.py").stat().st_mtime_ns
    os.utime(package / "more.py", ns=(date, date + 10**9))
    assert kernel_cache.kernel_folder(package) != before
    os.utime(package / "more.py", ns=(date, date))
    os.utime(package / "free.py", ns=(date, date + 10**9))
    assert kernel_cache.kernel_folder(package) == before


def run_python(script: str, **environment: str) -> str:
    """Output of ``script``, whose kernels are kept where the package says."""
    free = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"} | environment
    command = [sys.executable, "-c", script]
    return subprocess.run(command, env=free, capture_output=True, text=True, check=True).stdout.strip()


def test_numba_keeps_kernels_in_the_folder_of_the_package():
    kept = run_python("import heartfit, numba; print(numba.config.CACHE_DIR)")
    assert kept == str(kernel_cache.kernel_folder(Path(heartfit.__file__).parent))


def test_a_job_takes_the_folder_of_kernels_from_the_process_that_starts_it():
    kept = run_python(
        "import os, heartfit; print(os.environ['NUMBA_CACHE_DIR'])", NUMBA_CACHE_DIR="elsewhere"
    )
    assert kept == "elsewhere"
