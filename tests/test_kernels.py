"""The kernels are compiled once, for arrays as the study has them."""

from heartfit.kernels import compile_kernels
from heartfit.verification.block import cube


def test_the_beat_that_compiles_them_is_a_whole_one():
    beat = compile_kernels()
    assert beat.completed, beat.reason
    assert abs(beat.volume["lv"][0] - beat.volume["lv"]).max() > 1e-8, "the cube contracts"


def test_its_mesh_is_laid_out_as_those_read_from_files():
    block = cube(2, 0.02)
    assert all(each.flags.c_contiguous for each in (block.points, block.tets, block.fibres)), (
        "or numba compiles again"
    )
