"""Meshes followed through images of tissue whose motion is known."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from heartfit.core.errors import InputError
from heartfit.geometry.cube import cube
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.imaging.registration import track as module
from heartfit.imaging.registration.lattice import Lattice
from heartfit.imaging.registration.terms import Bending
from heartfit.imaging.registration.track import FreeForm, Tracking, track
from heartfit.imaging.sequence import Grid, ImageSequence

FRAMES = 8
EDGE, VOXEL = 36e-3, 3e-3
TIMES, PERIOD = 0.1 * np.arange(FRAMES), 0.8
COURSE = np.array([0.0, 0.15, 0.5, 0.85, 1.0, 0.85, 0.5, 0.15])
"""Away from end diastole and back to it."""

MIDDLE = np.full(3, 0.5 * EDGE)
TURN = Rotation.from_rotvec([0.2, -0.3, 0.25]).as_matrix()
STIFF = FreeForm(stiffness=4e-7)
"""An affine motion has no bending energy, so the stiffness adds no penalty."""

Affine = Callable[[float], tuple[np.ndarray, np.ndarray]]
"""The gradient (3,3) and the shift (3,) m of a motion about the middle when so much of it has happened."""


def shift(share: float) -> tuple[np.ndarray, np.ndarray]:
    return np.eye(3), share * np.array([3.7e-3, -2.2e-3, 1.3e-3])


def rotation(share: float) -> tuple[np.ndarray, np.ndarray]:
    return Rotation.from_rotvec(share * np.array([0.06, 0.12, 0.15])).as_matrix(), np.zeros(3)


def contraction(share: float) -> tuple[np.ndarray, np.ndarray]:
    """Shorter by 15 % along one axis, by 8 % along another, and thicker along the third for it."""
    stretch = 1.0 - share * np.array([0.15, 0.08, 0.0])
    return np.diag([*stretch[:2], 1.0 / stretch[:2].prod()]), np.zeros(3)


def dilation(share: float) -> tuple[np.ndarray, np.ndarray]:
    return (1.0 + 0.06 * share) * np.eye(3), np.zeros(3)


def travel(share: float) -> tuple[np.ndarray, np.ndarray]:
    """Shift of about one wavelength of the texture."""
    return np.eye(3), share * np.array([8e-3, -5e-3, 4e-3])


def nothing(share: float) -> tuple[np.ndarray, np.ndarray]:
    return np.eye(3), np.zeros(3)


def shell() -> VentricularMesh:
    """A box of muscle with a hollow."""
    block = cube(6, EDGE)
    middle = block.points[block.tets].mean(axis=1)
    walls = np.abs(middle - MIDDLE).max(axis=1) > EDGE / 6.0
    return VentricularMesh(block.points, block.tets[walls], block.surfaces)


def texture(places: np.ndarray, seed: int = 0) -> np.ndarray:
    """Forty waves of 9 to 25 mm in all directions."""
    rng = np.random.default_rng(seed)
    waves = rng.standard_normal((40, 3))
    waves *= (2.0 * np.pi / rng.uniform(9e-3, 25e-3, 40) / np.linalg.norm(waves, axis=1))[:, None]
    phases = rng.uniform(0.0, 2.0 * np.pi, 40)
    return sum(np.cos(places @ wave + phase) for wave, phase in zip(waves, phases, strict=True))


def displaced(points: np.ndarray, motion: Affine, share: float) -> np.ndarray:
    gradient, step = motion(share)
    return (points - MIDDLE) @ gradient.T + step + MIDDLE


def grid_of(spacing: np.ndarray, direction: np.ndarray) -> Grid:
    """Voxels around the box, beyond its motion."""
    size = np.round((EDGE + 22e-3) / spacing).astype(int)
    corner = MIDDLE - direction @ (0.5 * (size - 1) * spacing)
    return Grid((int(size[0]), int(size[1]), int(size[2])), spacing, corner, direction)


@cache
def imaged(motion: Affine, thickness: float = VOXEL, turned: bool = False) -> ImageSequence:
    """Tissue and surroundings move: the texture at x is that of the place of x at end diastole."""
    grid = grid_of(np.array([VOXEL, VOXEL, thickness]), TURN if turned else np.eye(3))
    shown = {share: texture(origins(grid, motion, share)) for share in np.unique(COURSE)}
    frames = np.array([shown[share] for share in COURSE], dtype=np.float32)
    return ImageSequence(grid, frames, TIMES, PERIOD)


def origins(grid: Grid, motion: Affine, share: float) -> np.ndarray:
    """Places at end diastole (k,j,i,3) of the points now in the voxels' centres [m]."""
    places = grid.points(np.moveaxis(np.indices(grid.shape), 0, -1)[..., ::-1].astype(float))
    gradient, step = motion(share)
    return (places - MIDDLE - step) @ np.linalg.inv(gradient).T + MIDDLE


def errors(tracking: Tracking, mesh: VentricularMesh, motion: Affine) -> np.ndarray:
    """Distances (p,n), in voxels of 3 mm, between where nodes are and where they are said to be."""
    true = np.array([displaced(mesh.points, motion, share) for share in COURSE])
    return np.linalg.norm(tracking.motion.positions - true, axis=-1) / VOXEL


@pytest.fixture(scope="module")
def box() -> VentricularMesh:
    return shell()


@pytest.mark.parametrize("motion", [shift, rotation, contraction])
def test_a_known_motion_is_found_to_a_fifth_of_a_voxel(box: VentricularMesh, motion: Affine) -> None:
    """Errors in all of the tissue, which moves by up to a voxel and a half; a twentieth on average."""
    tracking = track(imaged(motion), box, STIFF)
    error = errors(tracking, box, motion)
    assert np.linalg.norm(displaced(box.points, motion, 1.0) - box.points, axis=1).max() > VOXEL
    assert error.max() < 0.2
    assert error.mean() < 0.05
    assert tracking.mismatch.max() < 0.05
    assert tracking.compression.min() > 0.9


def test_still_images_give_no_motion(box: VentricularMesh) -> None:
    tracking = track(imaged(nothing), box, STIFF)
    assert tracking.motion.positions == pytest.approx(np.tile(box.points, (FRAMES, 1, 1)), abs=1e-9)
    assert tracking.mismatch.max() < 1e-6
    assert tracking.compression == pytest.approx(np.ones(FRAMES), abs=1e-6)


def test_voxels_need_not_be_cubes_nor_stand_along_the_axes(box: VentricularMesh) -> None:
    """The motion is the same to a twentieth of a voxel on average, and to a fifth except in a corner of the box."""
    straight = track(imaged(contraction), box, STIFF).motion.positions
    for thickness, turned in ((4e-3, False), (VOXEL, True)):
        tracking = track(imaged(contraction, thickness, turned), box, STIFF)
        error = errors(tracking, box, contraction)
        assert error.mean() < 0.05
        assert np.quantile(error, 0.99) < 0.2
        distance = np.linalg.norm(tracking.motion.positions - straight, axis=-1) / VOXEL
        assert distance.mean() < 0.05


def test_frames_in_reverse_order_give_the_same_beat(box: VentricularMesh) -> None:
    """Frames are matched forwards up to the middle and backwards from the end: reversed, they give the same places."""
    images = imaged(shift)
    back = [0, *range(FRAMES - 1, 0, -1)]
    reversed_ = replace(images, voxels=images.voxels[back])
    forwards, backwards = (track(sequence, box, STIFF).motion.positions for sequence in (images, reversed_))
    assert backwards[back] == pytest.approx(forwards, abs=0.05 * VOXEL)


def test_the_same_images_give_the_same_motion_to_the_bit_and_brightness_has_no_unit(
    box: VentricularMesh,
) -> None:
    images = imaged(rotation)
    first = track(images, box, STIFF)
    again = track(images, box, STIFF)
    np.testing.assert_array_equal(first.motion.positions, again.motion.positions)
    np.testing.assert_array_equal(first.mismatch, again.mismatch)
    brighter = track(replace(images, voxels=40.0 * images.voxels + 900.0), box, STIFF)
    assert brighter.motion.positions == pytest.approx(first.motion.positions, abs=0.01 * VOXEL)


def test_the_compared_region_has_the_voxels_on_its_edge_whatever_the_last_bits_of_their_size(
    box: VentricularMesh,
) -> None:
    """Voxels two of their widths from the wall lie on the edge of a region of that reach."""
    images = imaged(contraction)
    wider = replace(images.grid, spacing=np.nextafter(images.grid.spacing, 1.0))
    first, other = (
        track(replace(images, grid=grid), box, replace(STIFF, reach=2.0 * VOXEL))
        for grid in (images.grid, wider)
    )
    assert other.motion.positions == pytest.approx(first.motion.positions, abs=1e-3 * VOXEL)


def test_the_first_phase_is_the_mesh_itself_at_the_times_of_the_frames(box: VentricularMesh) -> None:
    tracking = track(imaged(shift), box, STIFF).motion
    np.testing.assert_array_equal(tracking.positions[0], box.points)
    np.testing.assert_array_equal(tracking.times, TIMES)
    assert tracking.period == PERIOD


def test_a_frame_starts_from_the_displacement_of_its_neighbour(box: VentricularMesh) -> None:
    """Three voxels away another wave of the texture is as near as the right one; coarse images are not asked here."""
    error = errors(track(imaged(travel), box, replace(STIFF, levels=((1, 10),))), box, travel)
    assert error.mean() < 0.1


def test_a_larger_weight_preserves_the_muscle_volume_more(box: VentricularMesh) -> None:
    """Images of a wall that grows by 1.06^3: recovered with free volume, and hardly with penalised volume."""

    def growth(incompressibility: float) -> float:
        settings = replace(STIFF, incompressibility=incompressibility)
        positions = track(imaged(dilation), box, settings).motion.positions
        return box.with_points(positions[4]).wall_volume() / box.wall_volume()

    assert growth(0.0) == pytest.approx(1.06**3, abs=0.01)
    assert growth(1.0) == pytest.approx(1.0, abs=0.02)


def test_the_stiffness_weighs_second_derivatives_in_metres(
    box: VentricularMesh, monkeypatch: pytest.MonkeyPatch
) -> None:
    """u_x = k x^2 / 2 costs s k^2 for each voxel, k in 1/m and s in m^2, whatever the voxels' size."""
    terms: list[tuple[Lattice, Bending]] = []

    def bending(lattice: Lattice, stiffness: float) -> Bending:
        terms.append((lattice, Bending(lattice, stiffness)))
        return terms[-1][1]

    monkeypatch.setattr(module, "Bending", bending)
    k, settings = 3.0, replace(STIFF, levels=((4, 0),))
    track(imaged(nothing), box, settings)
    lattice, term = terms[0]
    knots = settings.knots / VOXEL
    x = knots * (np.arange(lattice.zeros().shape[1]) - 1.0)
    bent = lattice.zeros().astype(float)
    bent[0] = (0.5 * k * VOXEL * (x**2 - knots**2 / 3.0))[:, None, None]
    expected = settings.stiffness * k**2 * np.prod(lattice.shape)
    assert term.linearise(bent).value == pytest.approx(expected, rel=1e-4)


def other_tissue() -> ImageSequence:
    """Still images, except for frames 3 and 4, which no smooth motion of the first gives."""
    images = imaged(nothing)
    voxels = images.voxels.copy()
    voxels[3:5] = texture(origins(images.grid, nothing, 0.0), seed=5)
    return replace(images, voxels=voxels)


def test_a_frame_that_folds_the_wall_is_named(box: VentricularMesh) -> None:
    loose = replace(STIFF, knots=5e-3, stiffness=1e-16, incompressibility=0.0)
    with pytest.raises(InputError, match=r"\[3, 4\]"):
        track(other_tissue(), box, loose)


def test_a_frame_that_would_fold_the_wall_is_matched_stiffer(box: VentricularMesh) -> None:
    """Only folding frames: still frames keep their displacement."""
    tracking = track(other_tissue(), box, replace(STIFF, knots=5e-3, stiffness=4e-8, incompressibility=0.0))
    assert tracking.compression.min() > 0.0
    assert (tracking.compression[3:5] < 0.9).all()
    assert tracking.mismatch[3:5].min() > 0.05
    volumes = element_volumes(tracking.motion.positions[4], box.tets) / box.element_volumes()
    assert tracking.compression[4] == volumes.min()
