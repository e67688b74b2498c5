"""Terms of the registration: each force against differences of its value, each curvature against what it squares."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from heartfit.imaging.registration.lattice import Lattice
from heartfit.imaging.registration.terms import (
    Bending,
    Brightness,
    FixedImage,
    Linearised,
    PyramidLevel,
    Term,
    WallVolume,
)
from tests.shrinking import assert_derivative

SHAPE = (18, 20, 19)
KNOTS = 5.3
WEIGHT = 0.3


@pytest.fixture(scope="module")
def lattice() -> Lattice:
    return Lattice(SHAPE, KNOTS)


def random(lattice: Lattice, seed: int, size: float = 1.0) -> np.ndarray:
    """Double precision, in which the terms then work."""
    return size * np.random.default_rng(seed).standard_normal(lattice.zeros().shape)


def affine(lattice: Lattice, gradient: np.ndarray) -> np.ndarray:
    """Coefficients of the displacement (gradient - 1) x: a linear one is its own control points."""
    places = np.stack(
        np.meshgrid(*[KNOTS * (np.arange(n) - 1.0) for n in lattice.zeros().shape[1:]], indexing="ij")
    )
    return np.einsum("ab,b...->a...", gradient - np.eye(3), places)


def volume_of(lattice: Lattice, weight: np.ndarray, shrink: int = 2) -> WallVolume:
    return WallVolume(lattice, PyramidLevel.from_shape(SHAPE, shrink), weight, WEIGHT)


def one_voxel(place: tuple[int, int, int]) -> np.ndarray:
    weight = np.zeros(SHAPE)
    weight[place] = 1.0
    return weight


def middle() -> np.ndarray:
    """Far enough from the edges, beyond which no image is linear."""
    weight = np.zeros(SHAPE)
    weight[8:10, 8:12, 8:11] = 1.0
    return weight


def brightness_of(lattice: Lattice, moving: np.ndarray, weight: np.ndarray, shrink: int = 1) -> Brightness:
    fixed = np.random.default_rng(9).random(SHAPE)
    return Brightness(FixedImage(lattice, PyramidLevel.from_shape(SHAPE, shrink), fixed, weight), moving)


def ramp() -> np.ndarray:
    """Linear, so that its gradient is that of its interpolation."""
    return np.einsum("a,a...->...", [0.3, -0.2, 0.25], np.indices(SHAPE).astype(float))


def assert_force(term: Term, here: np.ndarray, step: np.ndarray) -> None:
    """The force is minus half the gradient of the value."""
    slope = -2.0 * (term.linearise(here).force * step).sum()
    assert_derivative(lambda c: np.array(term.linearise(c).value), np.array(slope), here, step)


def assert_rank_one(part: Linearised, step: np.ndarray) -> None:
    """One squared residual r^2 has the force -r g and the curvature g g', so that K d = f (f.d) / r^2."""
    expected = part.force * (part.force * step).sum() / part.value
    size = float(np.abs(expected).max())
    assert size > 0.0
    assert part.curvature(step) == pytest.approx(expected, abs=1e-5 * size)


def assert_diagonal(part: Linearised) -> None:
    """Diagonal of the curvature: its product with a unit coefficient, at that coefficient."""
    rng, largest = np.random.default_rng(0), float(part.diagonal.max())
    for place in np.argwhere(part.diagonal > 0.01 * largest)[rng.permutation(20)]:
        unit = np.zeros_like(part.force)
        unit[tuple(place)] = 1.0
        assert part.diagonal[tuple(place)] == pytest.approx(part.curvature(unit)[tuple(place)], rel=1e-4)


@pytest.mark.parametrize("seed", range(3))
def test_bending_s_force_and_curvature_are_those_of_its_value(lattice: Lattice, seed: int) -> None:
    term, here, step = Bending(lattice, 2.5), random(lattice, seed), random(lattice, seed + 10)
    assert_force(term, here, step)
    part = term.linearise(here)
    assert part.value == pytest.approx((here * part.curvature(here)).sum(), rel=1e-6)
    assert part.value == pytest.approx(2.5 * Bending(lattice, 1.0).linearise(here).value, rel=1e-6)
    assert part.diagonal == pytest.approx(2.5 * lattice.bending_diagonal, rel=1e-6)


def test_a_parabola_bends_by_the_square_of_its_second_derivative(lattice: Lattice) -> None:
    """u_x = k x^2 / 2, all of u_y = k y z: s k^2 and 2 s k^2 for each voxel."""
    k, voxels = 0.02, np.prod(SHAPE)
    x, y, z = np.meshgrid(*[KNOTS * (np.arange(n) - 1.0) for n in lattice.zeros().shape[1:]], indexing="ij")
    parabola, saddle = lattice.zeros().astype(float), lattice.zeros().astype(float)
    parabola[0], saddle[1] = 0.5 * k * (x**2 - KNOTS**2 / 3.0), k * y * z
    for bent, squares in ((parabola, k**2), (saddle, 2.0 * k**2), (parabola + saddle, 3.0 * k**2)):
        assert Bending(lattice, WEIGHT).linearise(bent).value == pytest.approx(
            WEIGHT * squares * voxels, rel=1e-4
        )


@pytest.mark.parametrize("seed", range(3))
def test_the_wall_s_force_is_minus_half_the_gradient(lattice: Lattice, seed: int) -> None:
    """States that compress and dilate by a fifth and more."""
    weight = np.random.default_rng(seed).random(SHAPE)
    assert_force(volume_of(lattice, weight), random(lattice, seed, 0.7), random(lattice, seed + 10, 0.05))


@pytest.mark.parametrize("seed", range(3))
def test_the_wall_s_curvature_is_that_of_gauss_and_newton(lattice: Lattice, seed: int) -> None:
    term = volume_of(lattice, one_voxel((9, 8, 10)))
    assert_rank_one(term.linearise(random(lattice, seed, 0.7)), random(lattice, seed + 10))


def test_the_wall_s_diagonal_is_exact_where_it_is_only_stretched(lattice: Lattice) -> None:
    """Along the axes, where volume depends on the slope of each component along its own axis alone."""
    weight = np.random.default_rng(0).random(SHAPE)
    assert_diagonal(volume_of(lattice, weight).linearise(affine(lattice, np.diag([1.25, 0.8, 1.1]))))


def test_curvatures_of_voxels_add_up(lattice: Lattice) -> None:
    here, step = random(lattice, 0, 0.5), random(lattice, 1)
    places = [(9, 8, 10), (7, 11, 8), (10, 9, 9)]
    for term_of in (volume_of, lambda lattice, weight: brightness_of(lattice, ramp(), weight)):
        together = term_of(lattice, sum(one_voxel(place) for place in places)).linearise(here)
        single_voxels = [term_of(lattice, one_voxel(place)).linearise(here) for place in places]
        assert together.value == pytest.approx(sum(part.value for part in single_voxels), rel=1e-5)
        for total, parts in (
            (together.curvature(step), [part.curvature(step) for part in single_voxels]),
            (together.diagonal, [part.diagonal for part in single_voxels]),
            (together.force, [part.force for part in single_voxels]),
        ):
            assert total == pytest.approx(sum(parts), abs=1e-5 * float(np.abs(total).max()))


def test_a_volume_preserving_displacement_has_no_penalty(lattice: Lattice) -> None:
    """A rotation, a shear, and a stretch that thins as much as it lengthens."""
    stretch = np.diag([1.25, 0.8, 1.0])
    shear = np.array([[1.0, 0.4, -0.2], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0]])
    turn = Rotation.from_euler("xyz", [0.4, -0.7, 0.3]).as_matrix()
    term = volume_of(lattice, np.ones(SHAPE))
    for gradient in (turn, shear, stretch, turn @ stretch @ shear):
        part = term.linearise(affine(lattice, gradient))
        assert part.value < 1e-8
        assert np.abs(part.force).max() < 1e-3 * part.diagonal.max() * KNOTS


@pytest.mark.parametrize("stretch", [0.9, 1.2])
@pytest.mark.parametrize("shrink", [1, 2])
def test_a_dilation_costs_the_square_of_the_volume_it_adds(
    lattice: Lattice, stretch: float, shrink: int
) -> None:
    """q (s^3 - 1)^2 for every voxel of the wall, however large the blocks."""
    wall = np.zeros(SHAPE)
    wall[2:8, 4:10, 6:14] = 1.0
    value = volume_of(lattice, wall, shrink).linearise(affine(lattice, stretch * np.eye(3))).value
    assert value == pytest.approx(WEIGHT * (stretch**3 - 1.0) ** 2 * wall.sum(), rel=1e-4)


@pytest.mark.parametrize("shrink", [1, 2])
def test_the_brightness_force_is_minus_half_the_gradient(lattice: Lattice, shrink: int) -> None:
    """A linear image has a quadratic value, whose central difference is the gradient in single precision."""
    weight = middle() * np.random.default_rng(3).random(SHAPE)
    term = brightness_of(lattice, ramp(), weight, shrink)
    here, step = random(lattice, 4, 0.5), random(lattice, 5, 0.5)
    difference = term.linearise(here + step).value - term.linearise(here - step).value
    assert -4.0 * (term.linearise(here).force * step).sum() == pytest.approx(difference, rel=1e-4)
    bend = (
        term.linearise(here + step).value
        + term.linearise(here - step).value
        - 2.0 * term.linearise(here).value
    )
    assert 2.0 * (step * term.linearise(here).curvature(step)).sum() == pytest.approx(bend, rel=1e-3)


def test_the_brightness_curvature_is_that_of_gauss_and_newton(lattice: Lattice) -> None:
    term = brightness_of(lattice, np.random.default_rng(6).random(SHAPE), one_voxel((9, 8, 10)))
    part = term.linearise(random(lattice, 7, 0.5))
    assert_rank_one(part, random(lattice, 8))
    assert_diagonal(part)


def test_an_image_moved_by_the_displacement_does_not_differ(lattice: Lattice) -> None:
    """F(x) = M(x + u): a ramp shifted by u has brightness a.u less; the mismatch without u is |a.u|."""
    shift = np.array([1.5, -0.5, 1.0])
    moving, slope = ramp(), np.array([0.3, -0.2, 0.25])
    weight = middle()
    fixed = FixedImage(lattice, PyramidLevel.from_shape(SHAPE, 1), moving + slope @ shift, weight)
    term = Brightness(fixed, moving)
    displaced = np.broadcast_to(shift[:, None, None, None], lattice.zeros().shape)
    assert term.mismatch(displaced) == pytest.approx(0.0, abs=1e-4 * np.abs(slope @ shift))
    assert term.mismatch(lattice.zeros()) == pytest.approx(abs(slope @ shift), rel=1e-4)
    assert term.linearise(lattice.zeros()).value == pytest.approx(
        weight.sum() * (slope @ shift) ** 2, rel=1e-4
    )
