"""The comparison of registrations: motions that are known exactly, and the tables."""

import numpy as np
import pytest
import SimpleITK as sitk

from benchmarks.registration.carried import Images, nothing
from benchmarks.registration.library import affine_first, demons, splines
from benchmarks.registration.methods import METHODS
from benchmarks.registration.row import Errors, Row
from benchmarks.registration.tables import contrasts_table, methods_table

SHIFT = np.array([1.5, -1.0, 2.0])
"""Voxels along i, j, k."""


def blobs(shift: np.ndarray) -> sitk.Image:
    """A smooth texture in a window, all of it moved."""
    k, j, i = np.indices((24, 26, 28), float)
    x, y, z = i - 13.5 - shift[0], j - 12.5 - shift[1], k - 11.5 - shift[2]
    window = np.exp(-(x**2 + y**2 + z**2) / 60.0)
    return sitk.GetImageFromArray(
        (window * (1.5 + np.cos(0.5 * x) * np.cos(0.5 * y) * np.cos(0.5 * z))).astype(np.float32)
    )


MATCHINGS = {
    "diffeomorphic": demons("diffeomorphic", ((2, 40), (1, 40)), 1.5),
    "fast symmetric": demons("fast symmetric", ((2, 40), (1, 40)), 1.5),
    "affine": affine_first(nothing),
    "affine, then demons": affine_first(demons("fast symmetric", ((1, 20),), 1.5)),
    "splines": splines(7.0, 30, 0.5, near=False, shrink=1),
}


@pytest.mark.parametrize("name", MATCHINGS)
def test_a_matching_finds_a_shift_in_the_sense_of_the_mesh(name):
    """fixed(x) = moving(x + shift): a node at x goes to x + shift, not back."""
    fixed, moving = blobs(np.zeros(3)), blobs(SHIFT)
    everywhere = sitk.Cast(fixed > -1.0, sitk.sitkUInt8)
    transform = MATCHINGS[name](Images(fixed, moving, everywhere, sitk.Transform(3, sitk.sitkIdentity)))
    for place in ([13.0, 12.0, 11.0], [10.0, 14.0, 12.0]):
        assert np.subtract(transform.TransformPoint(place), place) == pytest.approx(SHIFT, abs=0.1)


def errors(mean: float) -> Errors:
    return Errors(0.1, -0.2, -0.05, mean, 4e-3, 2, 0.15, 0.2, 0.17, 0.3)


def test_every_method_and_every_refusal_is_a_row():
    methods = {family: {name: Row(0.5, errors(2e-3)) for name in named} for family, named in METHODS.items()}
    shown = methods_table(methods).to_numpy().tolist()
    assert len(shown) == sum(map(len, METHODS.values()))
    assert shown[0][1:] == ["+10.0", "-20.0", "-5.0", "2.00", "4.0", "2", "15.0", "11.5", "0.50"]
    contrasts = {"usual": [Row(0.5, errors(1e-3)), Row(1.0, None, "frames [3] fold the wall")]}
    first, second = contrasts_table(contrasts).to_numpy().tolist()
    assert first == ["usual", "1", "+10.0", "-20.0", "-5.0", "1.00", "4.0", "2", "-2.0", "-5.7", "12.0"]
    assert second == ["usual", "2", "refused", *8 * [""]]
