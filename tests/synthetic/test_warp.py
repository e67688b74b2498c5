"""Warped images: exact in the wall, continued around it, through the plane, and registered back."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.synthetic import warp
from heartfit.synthetic.scanner import Scanner
from heartfit.synthetic.warp import (
    MARGIN,
    SPACING,
    Surroundings,
    material_points,
    moving_images,
    scanner_like,
    voxel_centres,
    warp_cine,
)

FRAMES, PERIOD, PIXEL = 8, 0.8, 4e-3
TIMES = np.arange(FRAMES) * PERIOD / FRAMES
AXES = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0]
SHIFT = np.array([2e-3, -1e-3, 3e-3])


def grid_about(mesh: VentricularMesh, step: float = 18e-3) -> Grid:
    """Distant oblique slices that hold the mesh."""
    along = mesh.points @ AXES
    low, high = along.min(axis=0) - 0.02, along.max(axis=0) + 0.02
    spacing = np.array([PIXEL, PIXEL, step])
    i, j, k = np.ceil((high - low) / spacing).astype(int) + 1
    return Grid((int(i), int(j), int(k)), spacing, AXES @ low, AXES)


@pytest.fixture(scope="module")
def images(ventricle: VentricularMesh) -> ImageSequence:
    """Brightness that rises along the axes of the images, other in every frame."""
    grid = grid_about(ventricle)
    k, j, i = np.indices(grid.shape)
    ramp = 1.0 * i + 2.0 * j + 10.0 * k
    voxels = np.array([ramp + frame for frame in range(FRAMES)], np.float32)
    return ImageSequence(grid, voxels, TIMES, PERIOD)


@pytest.fixture(scope="module")
def warped(ventricle: VentricularMesh) -> Motion:
    """Shrinks about its centre and moves as a whole."""
    centre = ventricle.points.mean(axis=0)
    phase = 0.5 * (1.0 - np.cos(2.0 * np.pi * TIMES / PERIOD))[:, None, None]
    shrunk = -0.15 * (ventricle.points - centre)
    return Motion(TIMES, PERIOD, ventricle.points + phase * (shrunk + SHIFT))


@pytest.fixture
def coarse_surroundings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Displacement around the wall on a coarser grid, for a test about the wall."""
    monkeypatch.setattr(warp, "SPACING", 2.0 * SPACING)


def test_material_points_of_an_affine_motion_are_exact(ventricle: VentricularMesh, warped: Motion) -> None:
    grid, centre = grid_about(ventricle), ventricle.points.mean(axis=0)
    recovered = material_points(grid, ventricle, warped.positions[FRAMES // 2])
    inside = ~np.isnan(recovered[..., 0])
    expected = centre + (voxel_centres(grid) - SHIFT - centre) / 0.85
    assert inside.sum() > 100
    assert recovered[inside] == pytest.approx(expected[inside], abs=1e-9)


def test_the_displacement_around_the_wall_is_harmonic_and_ends_at_the_box(
    ventricle: VentricularMesh, warped: Motion
) -> None:
    surroundings = Surroundings.about(grid_about(ventricle), warped)
    positions = warped.positions[FRAMES // 2]
    field = surroundings.extend(ventricle, positions, surroundings.rest())
    wall = ~np.isnan(material_points(surroundings.grid, ventricle, positions)[..., 0])
    size = np.linalg.norm(field, axis=-1)
    assert size[[0, -1]].max() < 0.1 * size[wall].max()
    assert size[~wall].max() <= size[wall].max() * 1.001, "a harmonic field has its extremes on the wall"
    middle = field[1:-1, 1:-1, 1:-1]
    neighbours = sum(np.roll(field, s, a)[1:-1, 1:-1, 1:-1] for a in range(3) for s in (1, -1)) / 6.0
    away = ~wall[1:-1, 1:-1, 1:-1]
    assert np.abs(middle - neighbours)[away].max() < 1e-2 * size.max()
    assert surroundings.grid.spacing == pytest.approx(SPACING)
    assert np.ptp(surroundings.grid.index(positions), axis=0).max() * SPACING < max(
        np.array(surroundings.grid.size) * SPACING - 1.9 * MARGIN
    )


@pytest.mark.usefixtures("coarse_surroundings")
def test_a_heart_at_rest_shows_the_images_themselves(
    ventricle: VentricularMesh, images: ImageSequence
) -> None:
    still = Motion(TIMES, PERIOD, np.tile(ventricle.points, (FRAMES, 1, 1)))
    warped = warp_cine(images, images.voxels, ventricle, still)
    np.testing.assert_allclose(warped.voxels, images.voxels, rtol=0.0, atol=1e-2)


@pytest.mark.usefixtures("coarse_surroundings")
def test_brightness_moves_with_the_wall_in_and_through_the_plane(
    ventricle: VentricularMesh, images: ImageSequence, warped: Motion
) -> None:
    first = np.broadcast_to(images.voxels[0], images.voxels.shape)
    shown, grid, frame = warp_cine(images, first, ventricle, warped), images.grid, FRAMES // 2
    origin = material_points(grid, ventricle, warped.positions[frame])
    inside = ~np.isnan(origin[..., 0])
    i, j, k = grid.index(origin[inside]).T
    assert np.abs(grid.index(origin[inside])[:, 2] - np.indices(grid.shape)[0][inside]).max() > 0.1
    expected = i + 2.0 * j + 10.0 * np.clip(k, 0, grid.size[2] - 1)
    difference = np.abs(shown.voxels[frame][inside] - expected)
    assert np.median(difference) < 2.0
    assert np.median(difference) < 0.5 * np.median(np.abs(images.voxels[0][inside] - expected))


@pytest.mark.usefixtures("coarse_surroundings")
def test_every_frame_keeps_its_own_brightness(
    ventricle: VentricularMesh, images: ImageSequence, warped: Motion
) -> None:
    """However coarse the displacement around the wall is."""
    rows, columns = images.grid.shape[1:]
    none = SliceMotion(images.grid, (0, 0), np.zeros((FRAMES, images.grid.size[2], rows, columns, 2)))
    arguments = images, none, ventricle, warped, Scanner()
    first, pasted = (moving_images(content, *arguments) for content in ("first", "every"))
    gain = (pasted.voxels - first.voxels).mean(axis=(1, 2, 3))
    assert gain == pytest.approx(np.arange(FRAMES), abs=1e-3)


def test_the_phantom_is_imaged_in_slices_of_the_same_distance(images: ImageSequence) -> None:
    scanner = scanner_like(images, 5e-3, Scanner(signal_to_noise=12.0))
    assert (scanner.slice_thickness, scanner.slice_gap) == pytest.approx((5e-3, 13e-3))
    assert (scanner.voxel, scanner.frames, scanner.signal_to_noise) == (PIXEL, FRAMES, 12.0)


def test_other_frames_are_refused(ventricle: VentricularMesh, images: ImageSequence, warped: Motion) -> None:
    longer = Motion(np.arange(9) * 0.08, PERIOD, np.tile(ventricle.points, (9, 1, 1)))
    with pytest.raises(InputError, match="9 simulated and 8 real frames"):
        warp_cine(images, images.voxels, ventricle, longer)
