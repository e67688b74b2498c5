"""Painting: exactly the voxels inside, for any displacement of slices, with the brightness of their tissue."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from heartfit.geometry.cube import cube
from heartfit.imaging.raster import interpolate, paint_inside, paint_wall, sample_fields

SHAPE = (22, 24, 26)
FLAT = np.ones((1, 1, 1))
ONE_TETRAHEDRON = np.array([[0, 1, 2, 3]])
REGULAR = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]])


def voxels(shape: tuple[int, int, int], shift: np.ndarray) -> np.ndarray:
    """Places of the samples of all voxels: (k,j,i,3) in the order i, j, k."""
    k, j, i = np.indices(shape)
    return np.stack([i + shift[k, 0], j + shift[k, 1], k], axis=-1)


def painted(points: np.ndarray, tets: np.ndarray, shape: tuple[int, int, int] = SHAPE) -> np.ndarray:
    image = np.zeros(shape)
    paint_wall(image, points, tets, points, FLAT, np.zeros((shape[0], 2)))
    return image > 0.0


def sphere(centre: np.ndarray, radius: float, count: int = 2000) -> tuple[np.ndarray, np.ndarray]:
    """Points spread evenly over a sphere and the triangles of their hull, normals outwards."""
    height = 1.0 - 2.0 * (np.arange(count) + 0.5) / count
    angle = np.pi * (1.0 + np.sqrt(5.0)) * np.arange(count)
    across = np.sqrt(1.0 - height**2)
    unit = np.column_stack([across * np.cos(angle), across * np.sin(angle), height])
    hull = ConvexHull(unit)
    a, b, c = np.moveaxis(unit[hull.simplices], 1, 0)
    outwards = (np.cross(b - a, c - a) * a).sum(axis=1) > 0.0
    triangles = np.where(outwards[:, None], hull.simplices, hull.simplices[:, ::-1])
    return centre + radius * unit, triangles.astype(np.int64)


def inside(
    corners: np.ndarray, triangles: np.ndarray, shift: np.ndarray | None = None, shape: tuple = SHAPE
) -> np.ndarray:
    image = np.zeros(shape)
    paint_inside(image, corners, triangles, 1.0, np.zeros((shape[0], 2)) if shift is None else shift)
    return image > 0.0


def within(corners: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Mask (k,j,i) of the voxels without negative barycentric coordinates, up to round-off."""
    local = (voxels(SHAPE, shift) - corners[0]) @ np.linalg.inv(corners[1:] - corners[0])
    return np.minimum(local.min(axis=-1), 1.0 - local.sum(axis=-1)) >= -1e-9


@pytest.mark.parametrize("seed", range(5))
def test_the_voxels_of_a_tetrahedron_are_those_with_no_negative_barycentric_coordinate(seed: int) -> None:
    """Includes displaced slices and tetrahedra that reach beyond the image."""
    rng = np.random.default_rng(seed)
    corners, shift = rng.uniform(-4.0, 28.0, (4, 3)), rng.normal(0.0, 2.0, (SHAPE[0], 2))
    image = np.zeros(SHAPE)
    paint_wall(image, corners, ONE_TETRAHEDRON, corners, FLAT, shift)
    assert image.sum() > 100
    np.testing.assert_array_equal(image > 0.0, within(corners, shift))


@pytest.mark.parametrize("order", [[0, 1, 2, 3], [2, 3, 0, 1], [1, 2, 3, 0]])
def test_a_face_along_the_rows_bounds_the_painted_voxels(order: list[int]) -> None:
    """An edge along i, and with it two slanted faces that no row crosses; voxels lie on it and on corners."""
    corners = np.array([[2.0, 2, 2], [12, 2, 2], [5, 12, 3], [6, 4, 12]])[order]
    mask = painted(corners, ONE_TETRAHEDRON)
    assert mask[2, 2, 2:13].all()
    np.testing.assert_array_equal(mask, within(corners, np.zeros((SHAPE[0], 2))))


def test_the_painted_volume_of_a_tetrahedron_converges_with_the_voxel() -> None:
    """At least with order 1, over tetrahedra that stand anywhere between the voxels and are turned against them."""
    rng = np.random.default_rng(0)
    corners, offsets = REGULAR @ np.linalg.qr(rng.standard_normal((3, 3)))[0], rng.random((20, 3))
    low, coarse, fine = corners.min(axis=0), 6, 24

    def error(n: int) -> float:
        """Root mean square error of the volume, 1/3, with voxels of 1/n."""
        counts = [
            painted(n * (corners - low) + offset, ONE_TETRAHEDRON, (2 * n,) * 3).sum() for offset in offsets
        ]
        return float(np.sqrt(np.mean((np.array(counts) / n**3 - 1.0 / 3.0) ** 2)))

    assert error(fine) < error(coarse) * coarse / fine
    assert error(fine) < 2e-3


@pytest.mark.parametrize("offset", [0.0, 1.0 / 3.0])
def test_a_wall_of_many_tetrahedra_has_no_holes(offset: float) -> None:
    """Includes faces, edges and corners at the voxels' centres."""
    block = cube(4, 12.0)
    mask = painted(block.points + 5.0 + offset, block.tets)
    place = voxels(SHAPE, np.zeros((SHAPE[0], 2))) - 5.0 - offset
    np.testing.assert_array_equal(mask, ((place >= 0.0) & (place <= 12.0)).all(axis=-1))


def test_a_flat_tetrahedron_paints_no_voxel() -> None:
    assert not painted(np.array([[2.0, 2, 2], [9, 2, 2], [2, 9, 2], [9, 9, 2]]), ONE_TETRAHEDRON).any()


@pytest.mark.parametrize("seed", range(3))
def test_texture_stays_with_the_tissue(seed: int) -> None:
    """A texture a.X + b, moved affinely with x = F X + t, is a.F^-1 (x - t) + b wherever tissue now is."""
    rng = np.random.default_rng(seed)
    block = cube(2, 12.0)
    slope, gradient = rng.normal(0.0, 1.0, 3), np.eye(3) + rng.normal(0.0, 0.1, (3, 3))
    material = block.points + np.array([6.0, 5.0, 4.0])
    shift = rng.normal(0.0, 1.0, (SHAPE[0], 2))
    texture = voxels(SHAPE, np.zeros((SHAPE[0], 2))) @ slope + 100.0
    image = np.zeros(SHAPE)
    paint_wall(image, material @ gradient.T + 1.0, block.tets, material, texture, shift)
    expected = (voxels(SHAPE, shift) - 1.0) @ np.linalg.inv(gradient).T @ slope + 100.0
    wall = image > 0.0
    assert wall.sum() > 1000
    np.testing.assert_allclose(image[wall], expected[wall], rtol=1e-12)


def test_between_voxels_a_field_is_linear_and_beyond_them_constant() -> None:
    field = np.random.default_rng(0).random((3, 4, 5))
    assert interpolate(field, 3.0, 2.0, 1.0) == field[1, 2, 3]
    assert interpolate(field, 1.5, 2.25, 0.0) == pytest.approx(
        0.75 * field[0, 2, 1:3].mean() + 0.25 * field[0, 3, 1:3].mean(), rel=1e-14
    )
    assert interpolate(field, -3.0, 9.0, 2.0) == field[2, 3, 0]
    assert interpolate(FLAT, 7.0, -7.0, 0.3) == 1.0


def test_several_fields_are_sampled_as_one_is_and_only_where_they_weigh() -> None:
    rng = np.random.default_rng(1)
    fields, index, weight = (
        rng.random((2, 3, 4, 5)),
        rng.uniform(-1.0, 5.0, (3, 2, 3, 4)),
        np.zeros((2, 3, 4)),
    )
    weight[:, 1:, ::2] = 0.5
    samples = sample_fields(fields, index, weight)
    assert samples.shape == (2, 2, 3, 4)
    for place in np.ndindex(weight.shape):
        k, j, i = index[(slice(None), *place)]
        expected = [interpolate(field, i, j, k) if weight[place] else 0.0 for field in fields]
        np.testing.assert_array_equal(samples[(slice(None), *place)], expected)


@pytest.mark.parametrize("seed", range(3))
def test_voxels_within_a_sphere_are_inside(seed: int) -> None:
    """Except for voxels nearer to the surface than its facets are; with the volume of the sphere."""
    rng = np.random.default_rng(seed)
    centre, radius = np.array([13.0, 12.0, 11.0]) + rng.random(3), 8.0
    corners, triangles = sphere(centre, radius)
    mask = inside(corners, triangles)
    distance = np.linalg.norm(voxels(SHAPE, np.zeros((SHAPE[0], 2))) - centre, axis=-1)
    facet = radius - np.linalg.norm(corners[triangles].mean(axis=1) - centre, axis=1).min()
    clear = np.abs(distance - radius) > facet
    assert clear.mean() > 0.98
    np.testing.assert_array_equal(mask[clear], distance[clear] < radius)
    assert mask.sum() == pytest.approx(4.0 / 3.0 * np.pi * radius**3, rel=0.01)
    np.testing.assert_array_equal(mask, inside(corners, triangles[:, ::-1]))


def test_a_hole_in_the_surface_s_inside_is_outside() -> None:
    outer, faces = sphere(np.array([12.3, 11.6, 10.7]), 9.0)
    inner, _ = sphere(np.array([13.1, 11.2, 10.1]), 4.0)
    shell = inside(np.vstack([outer, inner]), np.vstack([faces, faces[:, ::-1] + len(outer)]))
    np.testing.assert_array_equal(shell, inside(outer, faces) & ~inside(inner, faces))


@pytest.mark.parametrize("turn", range(4))
def test_rows_through_edges_and_corners_cross_a_surface_once(turn: int) -> None:
    """A pyramid lying on its side: rows meet edges of its slopes and, elsewhere, the diagonal of its base."""
    corners = np.array([[4.0, 12, 11], [12, 4, 3], [12, 20, 3], [12, 20, 19], [12, 4, 19]])
    ring = 1 + np.roll(np.arange(4), turn)
    slopes = [[0, b, a] for a, b in zip(ring, np.roll(ring, -1), strict=True)]
    base = [[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]
    mask = inside(corners, np.array(slopes + base))
    i, j, k = np.moveaxis(voxels(SHAPE, np.zeros((SHAPE[0], 2))), -1, 0)
    reach = i - 4.0 - np.maximum(np.abs(j - 12.0), np.abs(k - 11.0))
    assert mask[(reach > 0.0) & (i < 12.0)].all()
    assert not mask[(reach < 0.0) | (i > 12.0)].any()


@pytest.mark.parametrize("seed", range(3))
def test_a_displaced_slice_is_sampled_at_its_displaced_places(seed: int) -> None:
    """Equal to the opposite displacement of the surface, including places beyond the image's edge."""
    rng = np.random.default_rng(seed)
    corners, triangles = sphere(np.array([12.3, 11.6, 10.7]), 9.0, 300)
    shift = rng.normal(0.0, 6.0, (SHAPE[0], 2))
    mask = inside(corners, triangles, shift)
    for k in range(SHAPE[0]):
        shifted = inside(corners - [*shift[k], 0.0], triangles)
        np.testing.assert_array_equal(mask[k], shifted[k])
