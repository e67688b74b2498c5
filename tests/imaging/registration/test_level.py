"""Levels of a pyramid: places of their voxels, and preserved images and weights."""

import numpy as np
import pytest

from heartfit.imaging.registration.terms import PyramidLevel

SHAPE = (24, 25, 27)


@pytest.fixture(params=[1, 2, 3])
def level(request: pytest.FixtureRequest) -> PyramidLevel:
    return PyramidLevel.from_shape(SHAPE, request.param)


def test_a_block_lies_in_the_middle_of_its_voxels(level: PyramidLevel) -> None:
    for n, places in zip(SHAPE, level.places, strict=True):
        blocks = np.arange(n // level.shrink * level.shrink).reshape(-1, level.shrink)
        np.testing.assert_allclose(places, blocks.mean(axis=1))


def test_the_index_of_a_block_s_place_is_its_number(level: PyramidLevel) -> None:
    for places in level.places:
        np.testing.assert_allclose(level.index(places), np.arange(len(places)), atol=1e-12)


def test_a_linear_image_keeps_its_brightness_at_every_place(level: PyramidLevel) -> None:
    """Except near the edges, beyond which the image continues with its edge value; a constant image everywhere."""
    slope = (3.0, -1.0, 2.0)
    image = sum(a * x for a, x in zip(slope, np.indices(SHAPE), strict=True))
    expected = sum(a * x for a, x in zip(slope, np.meshgrid(*level.places, indexing="ij"), strict=True))
    inner = (slice(2, -2),) * 3
    assert level.reduce(image)[inner] == pytest.approx(expected[inner], abs=1e-4)
    assert level.reduce(np.full(SHAPE, 7.0)) == pytest.approx(np.full(expected.shape, 7.0))


def test_detail_smaller_than_a_block_is_averaged_away() -> None:
    checks = np.indices(SHAPE).sum(axis=0) % 2 * 2.0 - 1.0
    assert np.abs(PyramidLevel.from_shape(SHAPE, 2).reduce(checks)[1:-1, 1:-1, 1:-1]).max() < 1e-6


def test_a_weight_is_summed_over_each_block_without_the_remainder(level: PyramidLevel) -> None:
    weight = np.random.default_rng(0).random(SHAPE)
    total = level.block_sums(weight)
    s = level.shrink
    assert total[1, 2, 3] == pytest.approx(weight[s : 2 * s, 2 * s : 3 * s, 3 * s : 4 * s].sum(), rel=1e-6)
    kept = weight[tuple(slice(n // s * s) for n in SHAPE)]
    assert total.sum() == pytest.approx(kept.sum(), rel=1e-6)
    assert total.shape == tuple(n // s for n in SHAPE)
