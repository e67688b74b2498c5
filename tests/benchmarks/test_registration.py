"""The registrations of SimpleITK find a motion that is known exactly."""

import numpy as np
import pytest
import SimpleITK as sitk

from benchmarks.registration.carried import Images
from benchmarks.registration.library import demons, splines

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


@pytest.mark.parametrize("match", [demons(((2, 40), (1, 40)), 1.5), splines(7.0, 30, 0.5, shrink=1)])
def test_a_matching_finds_a_shift_in_the_sense_of_the_mesh(match):
    """fixed(x) = moving(x + shift): a node at x goes to x + shift, not back."""
    fixed, moving = blobs(np.zeros(3)), blobs(SHIFT)
    everywhere = sitk.Cast(fixed > -1.0, sitk.sitkUInt8)
    transform = match(Images(fixed, moving, everywhere, sitk.Transform(3, sitk.sitkIdentity)))
    for place in ([13.0, 12.0, 11.0], [10.0, 14.0, 12.0]):
        assert np.subtract(transform.TransformPoint(place), place) == pytest.approx(SHIFT, abs=0.1)
