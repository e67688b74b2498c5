"""Blood areas and the volume from them, of parametric ventricles that are painted into images in a known motion."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.sections import enclosed_area
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.observation.blood_area import MeasuredWall, blood_area, inside, read_blood_volume
from heartfit.observation.curve import Curve
from heartfit.observation.outlines import slice_plane
from verification.specimen import SHAPE

FRAMES, PERIOD = 10, 0.8
TIMES = np.arange(FRAMES) * PERIOD / FRAMES
GRID = Grid(
    (140, 130, 8), np.array([1.4e-3, 1.4e-3, 9e-3]), np.array([-0.1, 0.1, -8e-3]), np.diag([1.0, -1.0, -1.0])
)
SHARE = np.sin(np.pi * np.arange(FRAMES) / FRAMES) ** 2
BLOOD, WALL = 400.0, 90.0


@pytest.fixture(scope="module")
def wall() -> MeasuredWall:
    """The cavities shrink towards the long axis by up to 25 %, the base sinks by 8 mm."""
    surface: LabelledSurface = SHAPE.surface()
    squeezed = surface.points * (1.0 - 0.25 * SHARE[:, None, None] * [1.0, 1.0, 0.0])
    depth = surface.points[:, 2] / surface.points[:, 2].min()
    squeezed[..., 2] -= 8e-3 * SHARE[:, None] * (1.0 - depth)
    return MeasuredWall(surface, squeezed)


@pytest.fixture(scope="module")
def images(wall: MeasuredWall) -> ImageSequence:
    voxels = np.full((FRAMES, *GRID.shape), WALL)
    for frame in range(FRAMES):
        for k in range(GRID.size[2]):
            segments = wall.outline("lv_endo", GRID, k, frame)
            if len(segments):
                voxels[frame, k][inside(GRID, segments)] = BLOOD
    return ImageSequence(GRID, voxels.astype(np.float32), TIMES, PERIOD)


def surface_volume(wall: MeasuredWall) -> Curve:
    cavity = Cavity.from_endocardium(wall.surface, "lv_endo")
    return Curve(TIMES, np.array([cavity.volume(points) for points in wall.positions]), PERIOD)


def test_voxels_inside_an_outline_cover_its_area(wall: MeasuredWall) -> None:
    for k in wall.readable_slices(GRID):
        segments = wall.outline("lv_endo", GRID, k)
        area = abs(float(enclosed_area(segments, slice_plane(GRID, k)[1])))
        assert inside(GRID, segments).sum() * 1.4e-3**2 == pytest.approx(area, rel=0.02)


def test_slices_that_a_ring_passes_or_the_apex_leaves_are_not_read(wall: MeasuredWall) -> None:
    readable = wall.readable_slices(GRID)
    assert readable
    assert 0 not in readable, "the rings sink into it"
    assert GRID.size[2] - 1 not in readable


def test_the_area_is_that_of_the_painted_blood(wall: MeasuredWall, images: ImageSequence) -> None:
    k = wall.readable_slices(GRID)[0]
    painted = (images.voxels[:, k] == BLOOD).sum(axis=(1, 2)) * 1.4e-3**2
    assert blood_area(images, wall, k) == pytest.approx(painted)


def test_the_volume_follows_the_images_at_the_scale_of_the_surface(
    wall: MeasuredWall, images: ImageSequence
) -> None:
    volume = surface_volume(wall)
    read = read_blood_volume(images, wall, volume)
    assert read.values == pytest.approx(volume.values, rel=0.015), (
        "the base narrows less than the slices show"
    )
    dipped = np.array(images.voxels)
    dipped[5] = dipped[7]
    shown = read_blood_volume(replace(images, voxels=dipped), wall, volume)
    assert shown.values[5] > read.values[5] + 5e-6, "the images show another course, the surface does not"


def test_dark_blood_and_other_frames_are_refused(wall: MeasuredWall, images: ImageSequence) -> None:
    with pytest.raises(InputError, match="brighter blood"):
        read_blood_volume(replace(images, voxels=-images.voxels), wall, surface_volume(wall))
    fewer = replace(images, voxels=images.voxels[:-1], times=images.times[:-1])
    with pytest.raises(InputError, match="expected one number"):
        read_blood_volume(fewer, wall, surface_volume(wall))
