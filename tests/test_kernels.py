"""The kernels are compiled once, for arrays as the study has them."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from heartfit import compiled
from heartfit.cohort.cine import image_beat
from heartfit.cohort.scanner import Scanner
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.raster import paint_inside, paint_wall, sampled
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.kernels import compile_kernels
from heartfit.registration.track import FreeForm, track
from heartfit.verification.block import cube

OF_IMAGES = (paint_wall, paint_inside, sampled)


def test_the_beat_that_compiles_them_is_a_whole_one():
    beat = compile_kernels()
    assert beat.completed, beat.reason
    assert abs(beat.volume["lv"][0] - beat.volume["lv"]).max() > 1e-8, "the cube contracts"


def test_its_mesh_is_laid_out_as_those_read_from_files():
    block = cube(2, 0.02)
    assert all(each.flags.c_contiguous for each in (block.points, block.tets, block.fibres)), (
        "or numba compiles again"
    )


def test_images_of_a_mesh_from_a_file_need_no_other_kernels(ventricle: VentricularMesh, tmp_path: Path):
    compile_kernels()
    known = [list(kernel.signatures) for kernel in OF_IMAGES]
    assert all(known)
    write_mesh(tmp_path / "mesh.vtu", ventricle)
    mesh = read_mesh(tmp_path / "mesh.vtu")
    still = Motion(0.1 * np.arange(8), 0.8, np.tile(mesh.points, (8, 1, 1)))
    scanner = Scanner(frames=8, voxel=6e-3, slice_thickness=6e-3, subvoxel=6e-3, subframes=1)
    track(image_beat(mesh, still, scanner, 0), mesh, FreeForm(levels=((2, 1), (1, 1))))
    assert [list(kernel.signatures) for kernel in OF_IMAGES] == known


def test_kernels_of_other_sources_are_compiled_anew(tmp_path: Path):
    """One that a kernel inlines changes: the folder does, and comes back with what it was."""
    (tmp_path / "sphere").mkdir()
    inlined, other = tmp_path / "sphere" / "step.py", tmp_path / "cli.py"
    for file in (inlined, other):
        file.write_text("x = 1")
    before = compiled.folder_of_kernels(tmp_path)
    date = inlined.stat().st_mtime_ns
    os.utime(inlined, ns=(date, date + 10**9))
    assert compiled.folder_of_kernels(tmp_path) != before
    os.utime(inlined, ns=(date, date))
    os.utime(other, ns=(date, date + 10**9))
    assert compiled.folder_of_kernels(tmp_path) == before


def test_numba_keeps_them_there():
    says = "import heartfit, numba; print(numba.config.CACHE_DIR)"
    free = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    run = subprocess.run([sys.executable, "-c", says], env=free, capture_output=True, text=True, check=True)
    assert run.stdout.strip() == str(compiled.folder_of_kernels(Path(compiled.__file__).parent))
