"""The kernels are compiled once, for arrays as the study has them."""

from pathlib import Path

import numpy as np

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
