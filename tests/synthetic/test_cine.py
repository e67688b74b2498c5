"""Synthetic scanner: partial volume, temporal blur, noise and breath-holds against their definitions."""

from dataclasses import fields, replace

import numpy as np
import pytest
from scipy.ndimage import label

from heartfit.geometry.cavity import Cavity
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.sequence import ImageSequence
from heartfit.synthetic.cine import ScanPlan, image_beat
from heartfit.synthetic.scanner import Contrast, Scanner

PERIOD = 0.8
PHASES = 16
CLEAN = Scanner(
    frames=8,
    voxel=4e-3,
    slice_thickness=4e-3,
    subvoxel=2e-3,
    signal_to_noise=np.inf,
    window=0.0,
    subframes=1,
    contrast=Contrast(lung_texture=0.15),
)
BLACK_LUNG = Contrast(lung=0.0, lung_texture=0.0)
SILHOUETTE = Contrast(1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0)
OBLIQUE = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]


@pytest.fixture(scope="module")
def beating(ventricle: VentricularMesh) -> Motion:
    """Towards the apex by 12 mm and back."""
    times = np.arange(PHASES) * PERIOD / PHASES
    descent = 6e-3 * (1.0 - np.cos(2.0 * np.pi * times / PERIOD))
    up = LeftVentricularAxes.from_mesh(ventricle).axis
    return Motion(times, PERIOD, ventricle.points - descent[:, None, None] * up)


@pytest.fixture(scope="module")
def still(ventricle: VentricularMesh) -> Motion:
    return Motion(np.arange(8) * 0.1, PERIOD, np.tile(ventricle.points, (8, 1, 1)))


@pytest.fixture(scope="module")
def clean(ventricle: VentricularMesh, still: Motion) -> ImageSequence:
    return image_beat(ventricle, still, replace(CLEAN, contrast=BLACK_LUNG), 0)


@pytest.fixture(scope="module")
def noisy(ventricle: VentricularMesh, still: Motion) -> ImageSequence:
    return image_beat(ventricle, still, replace(CLEAN, contrast=BLACK_LUNG, signal_to_noise=20.0), 0)


@pytest.fixture
def plan() -> ScanPlan:
    """Grid of thick slices with gaps, in oblique directions."""
    scanner = Scanner(voxel=2e-3, slice_thickness=6e-3, slice_gap=2e-3, subvoxel=1e-3)
    return ScanPlan(np.array([0.01, -0.02, 0.03]), np.array([0.0255, -0.0045, 0.069]), OBLIQUE, scanner)


def places(grid) -> np.ndarray:
    return grid.points(np.moveaxis(np.indices(grid.shape), 0, -1)[..., ::-1].astype(float))


def test_slices_are_as_thick_and_as_far_apart_as_asked(plan: ScanPlan) -> None:
    assert plan.grid.spacing == pytest.approx([2e-3, 2e-3, 8e-3])
    assert plan.fine.spacing == pytest.approx([1e-3] * 3)
    assert (plan.across, plan.pitch, plan.inside) == (2, 8, 6)
    assert plan.grid.size == (8, 8, 5)


def test_a_voxel_lies_at_the_place_of_its_mean(plan: ScanPlan) -> None:
    """The mean of a linear brightness over a box is its value at the centre, wherever the gaps are."""
    slope = np.array([30.0, -20.0, 50.0])
    assert plan.mean(places(plan.fine) @ slope) == pytest.approx(places(plan.grid) @ slope, rel=1e-12)


def test_a_plate_has_the_partial_volume_of_its_slice(plan: ScanPlan) -> None:
    """A plate of 3 fine voxels that a slice of 6 holds, holds partly, or that lies partly in the gap of 2."""
    for first, expected in ((8, [0, 0.5, 0, 0, 0]), (13, [0, 1 / 6, 0, 0, 0]), (14, [0, 0, 1 / 6, 0, 0])):
        image = np.zeros(plan.fine.shape)
        image[first : first + 3] = 1.0
        mean = plan.mean(image)
        assert mean.max(axis=(1, 2)) == pytest.approx(expected, abs=1e-15)
        assert np.ptp(mean, axis=(1, 2)).max() == 0.0


def test_a_frame_is_the_mean_image_over_its_window(ventricle: VentricularMesh, beating: Motion) -> None:
    """Here of three instants which are frames of a faster scanner, the first one's before the trigger."""
    fast = image_beat(ventricle, beating, replace(CLEAN, frames=24), 0)
    slow = image_beat(ventricle, beating, replace(CLEAN, window=3.0 * PERIOD / 24.0, subframes=3), 0)
    expected = [fast.voxels[[3 * frame - 1, 3 * frame, 3 * frame + 1]].mean(axis=0) for frame in range(8)]
    assert slow.voxels == pytest.approx(np.array(expected), abs=1e-6)
    assert np.abs(slow.voxels - fast.voxels[::3]).max() > 0.1
    assert slow.times == pytest.approx(np.arange(8) * 0.1)


def test_noise_in_air_is_rayleigh_distributed(clean: ImageSequence, noisy: ImageSequence) -> None:
    """Mean s sqrt(pi/2), standard deviation s sqrt(2 - pi/2), within 4 standard errors."""
    sigma, air = 1.0 / 20.0, noisy.voxels[clean.voxels == 0.0].astype(float)
    spread = sigma * np.sqrt(2.0 - np.pi / 2.0)
    assert air.mean() == pytest.approx(sigma * np.sqrt(np.pi / 2.0), abs=4.0 * spread / np.sqrt(air.size))
    assert air.std() == pytest.approx(spread, abs=4.0 * spread / np.sqrt(2.0 * air.size))


def test_noise_in_blood_is_that_of_one_channel(clean: ImageSequence, noisy: ImageSequence) -> None:
    """Mean sqrt(A^2 + s^2) to order s^4 and standard deviation s to order s^3, within 4 standard errors."""
    sigma, blood = 1.0 / 20.0, noisy.voxels[clean.voxels == 1.0].astype(float)
    assert blood.size > 10000
    assert blood.mean() == pytest.approx(np.sqrt(1.0 + sigma**2), abs=4.0 * sigma / np.sqrt(blood.size))
    assert blood.std() == pytest.approx(sigma, abs=4.0 * sigma / np.sqrt(2.0 * blood.size) + sigma**3)


def test_noise_differs_from_voxel_to_voxel_and_from_frame_to_frame(
    clean: ImageSequence, noisy: ImageSequence
) -> None:
    noise = (noisy.voxels - clean.voxels)[:, (clean.voxels == 1.0).all(axis=0)]
    between = np.corrcoef(noise) - np.eye(len(noise))
    assert np.abs(between).max() < 5.0 / np.sqrt(noise.shape[1])


def test_the_same_seed_gives_the_same_image_to_the_bit_and_another_one_other_noise(
    ventricle: VentricularMesh, still: Motion, noisy: ImageSequence
) -> None:
    scanner = replace(CLEAN, contrast=BLACK_LUNG, signal_to_noise=20.0)
    assert np.array_equal(image_beat(ventricle, still, scanner, 0).voxels, noisy.voxels)
    assert not np.isclose(image_beat(ventricle, still, scanner, 1).voxels, noisy.voxels).mean() > 0.01


def test_a_slice_is_displaced_in_its_plane_as_a_whole_and_each_by_its_own_breath_hold(
    ventricle: VentricularMesh, still: Motion
) -> None:
    """The centre of the heart's silhouette moves with it; by the asked amount, within 3 standard errors."""
    scanner = replace(CLEAN, contrast=SILHOUETTE, subvoxel=1e-3)
    straight, shifted = (
        image_beat(ventricle, still, replace(scanner, breath_hold_shift=amount), 0) for amount in (0.0, 4e-3)
    )
    heart = straight.voxels[0].sum(axis=(1, 2)) > 20.0
    shift = centres(shifted)[:, heart] - centres(straight)[:, heart]
    draws = 2 * heart.sum()
    assert draws > 30
    assert np.ptp(shift, axis=0).max() == 0.0, "a still heart is displaced equally in every frame"
    assert np.sqrt((shift**2).mean()) == pytest.approx(4e-3, rel=3.0 / np.sqrt(2.0 * draws))
    assert np.corrcoef(shift[0, :-1].ravel(), shift[0, 1:].ravel())[0, 1] < 3.0 / np.sqrt(draws)


def centres(sequence: ImageSequence) -> np.ndarray:
    """Centres of brightness (p,k,2) in each slice's plane, m."""
    j, i = np.indices(sequence.grid.shape[1:]) * sequence.grid.spacing[0]
    mass = sequence.voxels.sum(axis=(2, 3)).clip(1e-12)
    return np.stack([(sequence.voxels * place).sum(axis=(2, 3)) / mass for place in (i, j)], axis=-1)


def test_the_bright_voxels_of_the_left_ventricle_have_its_volume(
    ventricle: VentricularMesh, still: Motion
) -> None:
    """Voxels brighter than the mean of muscle and blood that are connected with the cavity's middle.

    The leaflets are black here: thinner than a voxel, they would not keep the atrium apart otherwise.
    """
    images = image_beat(ventricle, still, replace(CLEAN, contrast=replace(BLACK_LUNG, leaflets=0.0)), 0)
    bright = label(images.voxels[0] > 0.7)[0]
    middle = ventricle.points[np.unique(ventricle.surfaces["lv_endo"])].mean(axis=0)
    i, j, k = np.rint(images.grid.index(middle)).astype(int)
    volume = (bright == bright[k, j, i]).sum() * images.grid.spacing.prod()
    assert volume == pytest.approx(
        Cavity.from_endocardium(ventricle, "lv_endo").volume(ventricle.points), rel=0.05
    )


def test_the_scanner_returns_images_only(clean: ImageSequence) -> None:
    assert {field.name for field in fields(clean)} == {"grid", "voxels", "times", "period"}
    assert set(vars(clean)) == {"grid", "voxels", "times", "period"}
    assert clean.voxels.dtype == np.float32
