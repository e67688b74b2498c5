"""Known displacements: a shift, a linear map, and the same result twice."""

import numpy as np
import pytest

from heartfit.imaging.registration.slices import Demons, jacobian, register


def texture(shape: tuple[int, ...], shift: tuple[float, ...]) -> np.ndarray:
    """Blobs in a smooth window, all of it moved by shift along i, j(, k)."""
    axes = np.meshgrid(*(np.arange(size) - (size - 1) / 2 for size in shape), indexing="ij")
    x = [axis - step for axis, step in zip(axes[::-1], shift, strict=True)]
    window = np.exp(-sum((axis / (0.3 * shape[0])) ** 2 for axis in x))
    return 100.0 * window * (1.5 + np.prod([np.cos(0.5 * axis) for axis in x], axis=0))


@pytest.mark.parametrize(("shape", "shift"), [((48, 56), (2.3, -1.4)), ((24, 24, 28), (1.2, 0.8, -0.9))])
def test_a_shift_is_found_to_a_twentieth_of_a_voxel(shape: tuple[int, ...], shift: tuple[float, ...]) -> None:
    """Independent of the smoothing, since a shift is perfectly smooth."""
    still = (0.0,) * len(shape)
    displacement = register(texture(shape, still), texture(shape, shift), Demons(smoothing=3.0))
    inner = tuple(slice(size // 3, 2 * size // 3) for size in shape)
    assert np.abs(displacement[inner] - shift).max() < 0.05


def test_the_same_images_give_the_same_displacement_to_the_bit() -> None:
    fixed, moving = texture((40, 44), (0.0, 0.0)), texture((40, 44), (1.5, 0.7))
    method = Demons(smoothing=1.5)
    assert np.array_equal(register(fixed, moving, method), register(fixed, moving, method))
    assert np.abs(register(fixed, fixed, method)).max() < 1e-3


@pytest.mark.parametrize("dimension", [2, 3])
def test_the_jacobian_of_a_linear_map_is_its_determinant(dimension: int) -> None:
    slope = np.random.default_rng(5).normal(0.0, 0.3, (dimension, dimension))
    place = np.stack(np.meshgrid(*[np.arange(5.0)] * dimension, indexing="ij")[::-1], axis=-1)
    expected = np.linalg.det(np.eye(dimension) + slope)
    assert jacobian(place @ slope.T) == pytest.approx(expected, rel=1e-12)
