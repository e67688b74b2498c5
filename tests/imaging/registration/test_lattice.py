"""B-splines: the polynomials that they reproduce, their derivatives, their bending, and that a transpose is one."""

import numpy as np
import pytest

from heartfit.imaging.registration.lattice import Lattice

SHAPES = [(23,), (14, 17), (9, 12, 11)]
KNOTS = 3.7


def monomial(degree: int, count: int) -> np.ndarray:
    """The coefficients of (x / h)^degree: sum_c B(xi - c) c^m is xi^m and lower powers, B's variance being 1/3."""
    c = np.arange(count) - 1.0
    return np.array([np.ones(count), c, c**2 - 1.0 / 3.0, c**3 - c][degree])


def coefficients(lattice: Lattice, degrees: tuple[int, ...]) -> np.ndarray:
    """Coefficients of the displacement whose every component is prod_a (x_a / h)^degree_a."""
    dimension, *counts = lattice.zeros().shape
    result = np.ones(counts)
    for axis, (degree, count) in enumerate(zip(degrees, counts, strict=True)):
        result = result * monomial(degree, count).reshape([-1 if a == axis else 1 for a in range(dimension)])
    return np.tile(result, (dimension, *[1] * dimension))


def random(lattice: Lattice, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(lattice.zeros().shape)


def voxels(shape: tuple[int, ...]) -> list[np.ndarray]:
    return [np.arange(float(n)) for n in shape]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("degree", range(4))
def test_polynomials_up_to_cubic_are_reproduced(shape: tuple[int, ...], degree: int) -> None:
    """Includes constants (the B-splines are a partition of unity), up to the image's edges."""
    lattice, last = Lattice(shape, KNOTS), np.array(shape) - 1.0
    places = np.vstack([np.random.default_rng(0).random((50, len(shape))) * last, 0.0 * last, last])
    degrees = tuple((degree + axis) % 4 for axis in range(len(shape)))
    expected = np.prod((places / KNOTS) ** degrees, axis=1)
    displacement = lattice.evaluate(coefficients(lattice, degrees), places)
    assert displacement == pytest.approx(np.tile(expected[:, None], len(shape)), rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("shape", SHAPES)
def test_sampling_on_a_grid_equals_sampling_at_scattered_places(shape: tuple[int, ...]) -> None:
    lattice = Lattice(shape, KNOTS)
    places = [np.sort(np.random.default_rng(a).random(4 + a)) * (n - 1) for a, n in enumerate(shape)]
    scattered = np.stack(np.meshgrid(*places, indexing="ij"), axis=-1).reshape(-1, len(shape))
    displacement = lattice.sampling(places).displacement(random(lattice, 1))
    expected = lattice.evaluate(random(lattice, 1), scattered).T.reshape(displacement.shape)
    assert displacement == pytest.approx(expected, abs=1e-6)


def test_beyond_the_image_the_displacement_is_that_of_its_edge() -> None:
    lattice = Lattice((9, 12, 11), KNOTS)
    far, edge = np.array([[-4.0, 5.0, 99.0]]), np.array([[0.0, 5.0, 10.0]])
    assert lattice.evaluate(random(lattice, 0), far) == pytest.approx(
        lattice.evaluate(random(lattice, 0), edge)
    )


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("knots", [1.0, 3.7, 4.0, 50.0])
def test_a_displacement_stays_between_its_control_points(shape: tuple[int, ...], knots: float) -> None:
    """All B-splines are non-negative with sum one, for any number of them and at the image's edges."""
    lattice = Lattice(shape, knots)
    ones = np.ones_like(lattice.zeros())
    for axis, count in enumerate(ones.shape[1:], start=1):
        for one in range(count):
            single = np.where((np.arange(count) == one).reshape(-1, *[1] * (len(shape) - axis)), ones, 0.0)
            assert lattice.sampling(voxels(shape)).displacement(single).min() > -1e-7
    assert lattice.sampling(voxels(shape)).displacement(ones) == pytest.approx(
        np.ones((len(shape), *shape)), abs=1e-6
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_the_derivative_of_a_cubic_is_its_quadratic(shape: tuple[int, ...]) -> None:
    """d/dx (x/h)^3 = 3 (x/h)^2 / h along the asked axis and nothing else."""
    lattice = Lattice(shape, KNOTS)
    for axis in range(len(shape)):
        degrees = tuple(3 if a == axis else 1 for a in range(len(shape)))
        displacement = lattice.sampling(voxels(shape), axis).displacement(coefficients(lattice, degrees))
        xi = np.meshgrid(*[places / KNOTS for places in voxels(shape)], indexing="ij")
        expected = np.prod([3.0 * x**2 / KNOTS if a == axis else x for a, x in enumerate(xi)], axis=0)
        assert displacement == pytest.approx(
            np.broadcast_to(expected, displacement.shape), rel=1e-5, abs=1e-4
        )


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("along", [None, 0])
def test_the_transpose_is_the_transpose(shape: tuple[int, ...], along: int | None) -> None:
    """<A d, f> = <d, A' f>, and the diagonal of A' w A is that of the products with unit coefficients."""
    lattice = Lattice(shape, KNOTS)
    sampling, rng = (
        lattice.sampling([places[::2] for places in voxels(shape)], along),
        np.random.default_rng(2),
    )
    displaced = sampling.displacement(random(lattice, 3))
    field = rng.standard_normal(displaced.shape)
    back = sampling.transposed(field)
    assert back.shape == lattice.zeros().shape
    assert (displaced * field).sum() == pytest.approx((random(lattice, 3) * back).sum(), rel=1e-6)
    squares = rng.random(displaced.shape)
    diagonal = sampling.diagonal(squares)
    for _ in range(5):
        unit, place = lattice.zeros(), tuple(rng.integers(lattice.zeros().shape))
        unit[place] = 1.0
        assert diagonal[place] == pytest.approx((squares * sampling.displacement(unit) ** 2).sum(), rel=1e-5)


@pytest.mark.parametrize("shape", SHAPES[1:])
def test_an_affine_displacement_has_no_bending_energy(shape: tuple[int, ...]) -> None:
    lattice, rng = Lattice(shape, KNOTS), np.random.default_rng(4)
    dimension = len(shape)
    straight = lattice.zeros().astype(float)
    for degrees in [(0,) * dimension, *map(tuple, np.eye(dimension, dtype=int))]:
        share = rng.standard_normal((dimension, *[1] * dimension))
        straight += share * coefficients(lattice, degrees)
    size = np.abs(lattice.bending(random(lattice, 0))).max()
    assert lattice.bending(straight) == pytest.approx(np.zeros_like(straight), abs=1e-5 * size)


@pytest.mark.parametrize(("degrees", "squares"), [((2, 0, 0), 4.0), ((0, 1, 1), 2.0), ((0, 0, 2), 4.0)])
def test_bending_is_the_sum_of_squared_second_derivatives(degrees: tuple, squares: float) -> None:
    """Bending of x^2: 2^2; of y z: twice 1^2, for the two mixed derivatives; per voxel, component and h^-4."""
    lattice = Lattice((9, 12, 11), KNOTS)
    bent = coefficients(lattice, degrees)
    expected = squares * 3 * 9 * 12 * 11 / KNOTS**4
    assert (bent * lattice.bending(bent)).sum() == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("shape", SHAPES)
def test_bending_is_symmetric_and_its_diagonal_the_diagonal(shape: tuple[int, ...]) -> None:
    lattice, rng = Lattice(shape, KNOTS), np.random.default_rng(5)
    a, b = random(lattice, 6), random(lattice, 7)
    assert (a * lattice.bending(b)).sum() == pytest.approx((b * lattice.bending(a)).sum(), rel=1e-5)
    for _ in range(5):
        unit, place = lattice.zeros(), tuple(rng.integers(lattice.zeros().shape))
        unit[place] = 1.0
        diagonal = lattice.bending_diagonal[(0, *place[1:])]
        assert diagonal == pytest.approx(lattice.bending(unit)[place], rel=1e-5)
