"""The image between two slices shows a structure once, at the place between its places in both."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.between_slices import BetweenSlices
from heartfit.imaging.registration.slices import Demons

SHAPE, RADIUS, FAR = (64, 72), 10.0, 8.0


def disc(centre: float) -> np.ndarray:
    """A bright disc with its centre on the middle row."""
    j, i = np.indices(SHAPE)
    return 1.0 / (1.0 + np.exp(np.hypot(i - centre, j - SHAPE[0] / 2) - RADIUS))


@pytest.fixture(scope="module")
def stack() -> np.ndarray:
    return np.array([disc(30.0), disc(30.0 + FAR), disc(30.0 + FAR)])


@pytest.fixture(scope="module")
def between(stack: np.ndarray) -> BetweenSlices:
    return BetweenSlices.of(stack, Demons(smoothing=1.5))


def image(between: BetweenSlices, stack: np.ndarray, height: float) -> np.ndarray:
    j, i = np.indices(SHAPE).astype(float)
    return between.brightness(stack, np.stack([i, j, np.full(SHAPE, height)], axis=-1))


def test_the_slices_themselves_are_unchanged(between: BetweenSlices, stack: np.ndarray) -> None:
    for k, slice_ in enumerate(stack):
        assert image(between, stack, k) == pytest.approx(slice_, abs=1e-6)


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_a_structure_lies_between_its_places(between: BetweenSlices, stack: np.ndarray, share: float) -> None:
    expected, interpolated = disc(30.0 + share * FAR), image(between, stack, share)
    mean = (1.0 - share) * stack[0] + share * stack[1]
    assert np.abs(interpolated - expected).mean() < 0.25 * np.abs(mean - expected).mean()


def test_beyond_the_stack_the_outermost_slice_continues(between: BetweenSlices, stack: np.ndarray) -> None:
    assert image(between, stack, -1.5) == pytest.approx(stack[0], abs=1e-6)
    assert image(between, stack, 4.0) == pytest.approx(stack[2], abs=1e-6)


def test_a_single_slice_is_refused(stack: np.ndarray) -> None:
    with pytest.raises(InputError, match="two or more"):
        BetweenSlices.of(stack[:1])
