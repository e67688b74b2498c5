"""Scene at one instant: tissue at its place, texture carried along, slices displaced."""

import numpy as np
import pytest
from scipy.ndimage import label

from heartfit.core.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import rim_loops
from heartfit.imaging.raster import wall_voxels
from heartfit.imaging.sequence import Grid
from heartfit.synthetic.cine import ATRIUM, FAT, LEAFLET, ScanPlan, Scene, prism
from heartfit.synthetic.scanner import Contrast, Scanner

PLAN = Scanner(voxel=3e-3, slice_thickness=3e-3, subvoxel=1.5e-3, margin=40e-3)
PLAIN = Contrast(muscle_texture=0.0, lung_texture=0.0)


def scene_of(mesh: VentricularMesh, contrast: Contrast, shift: Floats | None = None) -> Scene:
    axes = LeftVentricularAxes.from_mesh(mesh)
    grid = ScanPlan.about(mesh, axes, PLAN).fine
    still = np.zeros((grid.size[2], 2))
    rng = np.random.default_rng(0)
    return Scene.of(mesh, axes.axis, grid, contrast, still if shift is None else shift, rng)


def sampled(scene: Scene, image: Floats, place: Floats) -> float:
    i, j, k = np.rint(scene.grid.index(place)).astype(int)
    return float(image[k, j, i])


def enclosed(corners: Floats, triangles: np.ndarray) -> float:
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6.0)


def test_the_prism_of_a_patch_is_closed_and_holds_area_times_height() -> None:
    corners = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [1, 0.4, 0]])
    patch = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    surface = prism(patch, len(corners))
    edges = np.vstack([surface[:, [0, 1]], surface[:, [1, 2]], surface[:, [2, 0]]]).tolist()
    assert sorted(edges) == sorted([b, a] for a, b in edges), "every edge is traversed once in each direction"
    assert enclosed(np.vstack([corners, corners + np.array([0.3, -0.2, 3.0])]), surface) == pytest.approx(6.0)


def test_texture_has_the_spread_and_length_asked_for(ventricle: VentricularMesh) -> None:
    """White noise smoothed by a Gaussian of deviation s is correlated by exp(-d^2 / 4 s^2) over a distance d."""
    contrast = Contrast(lung=0.5, lung_texture=0.3, texture_length=3e-3)
    lung = scene_of(ventricle, contrast).lung
    assert lung.mean() == pytest.approx(0.5, rel=1e-12)
    assert lung.std() == pytest.approx(0.15, rel=1e-12)
    varied = (lung - 0.5) / 0.15
    for axis in range(3):
        for steps in (1, 2, 4):
            expected = np.exp(-((1.5e-3 * steps) ** 2) / (4.0 * 3e-3**2))
            assert (varied * np.roll(varied, steps, axis)).mean() == pytest.approx(expected, abs=0.02)


def test_the_textures_of_muscle_lung_and_noise_are_independent(ventricle: VentricularMesh) -> None:
    scene = scene_of(ventricle, Contrast(texture_length=1e-4))
    muscle, lung = scene.muscle.ravel(), scene.lung.ravel()
    for lag in (0, 2, 2 * scene.grid.size[2]):
        assert abs(np.corrcoef(muscle, np.roll(lung, lag))[0, 1]) < 5.0 / np.sqrt(muscle.size)


def test_at_end_diastole_muscle_shows_its_own_texture(ventricle: VentricularMesh) -> None:
    scene = scene_of(ventricle, Contrast())
    wall = wall_voxels(scene.grid, ventricle)
    assert scene.at(ventricle.points)[wall] == pytest.approx(scene.muscle[wall], rel=1e-12)
    assert wall.sum() * scene.grid.spacing.prod() == pytest.approx(ventricle.wall_volume(), rel=0.01)


@pytest.mark.parametrize("descent", [0.0, 12e-3])
def test_blood_continues_beyond_the_leaflets(ventricle: VentricularMesh, descent: float) -> None:
    """Includes a lowered base: the atrium's roof stays, and the column of blood is longer."""
    scene = scene_of(ventricle, PLAIN)
    ring = ventricle.points[rim_loops(ventricle.surfaces["lv_endo"])[0]].mean(axis=0)
    valve = ring - descent * scene.up
    image = scene.at(ventricle.points - descent * scene.up)
    assert sampled(scene, image, valve - 15e-3 * scene.up) == PLAIN.blood
    assert sampled(scene, image, valve + 0.5 * LEAFLET * scene.up) == PLAIN.leaflets
    assert sampled(scene, image, valve + (LEAFLET + 3e-3) * scene.up) == PLAIN.blood
    assert sampled(scene, image, ring + (ATRIUM - 3e-3) * scene.up) == PLAIN.blood
    assert sampled(scene, image, ring + (ATRIUM + 3e-3) * scene.up) == PLAIN.lung


def test_fat_lies_on_the_muscle_of_the_base(ventricle: VentricularMesh) -> None:
    """No other tissue covers most of the fat."""
    scene = scene_of(ventricle, PLAIN)
    image = scene.at(ventricle.points)
    groove = ventricle.points[ventricle.surfaces["base"]].mean(axis=1)
    for height, brightness in ((0.5 * FAT, PLAIN.fat), (FAT + 3e-3, PLAIN.lung)):
        shown = np.array([sampled(scene, image, place + height * scene.up) for place in groove])
        assert (shown == brightness).mean() > 0.7


def test_the_blood_in_the_cavities_has_their_volume(ventricle: VentricularMesh) -> None:
    """Blood connected with the cavities well below the valves; the leaflets separate the atria."""
    scene = scene_of(ventricle, PLAIN)
    cavities = [Cavity.from_endocardium(ventricle, f"{side}_endo") for side in ("lv", "rv")]
    valves = min((ventricle.points[cavity.rim] @ scene.up).min() for cavity in cavities)
    pools = label(scene.at(ventricle.points) == PLAIN.blood)[0]
    k, j, i = np.nonzero(pools)
    low = scene.grid.points(np.column_stack([i, j, k]).astype(float)) @ scene.up < valves - 15e-3
    volume = np.isin(pools, np.unique(pools[k, j, i][low])).sum() * scene.grid.spacing.prod()
    assert volume == pytest.approx(sum(cavity.volume(ventricle.points) for cavity in cavities), rel=0.01)


def test_texture_moves_with_the_tissue(ventricle: VentricularMesh) -> None:
    scene = scene_of(ventricle, Contrast())
    steps = np.array([2.0, -1.0, 3.0])
    displaced = ventricle.with_points(ventricle.points + scene.grid.vectors(steps))
    wall = wall_voxels(scene.grid, ventricle)
    carried = np.roll(wall, (3, -1, 2), (0, 1, 2))
    expected = np.roll(scene.muscle, (3, -1, 2), (0, 1, 2))
    assert scene.at(displaced.points)[carried] == pytest.approx(expected[carried], rel=1e-9)


def test_a_displaced_slice_shows_the_heart_displaced_and_no_other_slice_does(
    ventricle: VentricularMesh,
) -> None:
    contrast = Contrast(lung_texture=0.0)
    still = scene_of(ventricle, contrast)
    shift = np.zeros((still.grid.size[2], 2))
    slice_, shift[40] = 40, (3.0, -2.0)
    displaced = scene_of(ventricle, contrast, shift).at(ventricle.points)
    image = still.at(ventricle.points)
    assert displaced[slice_] == pytest.approx(np.roll(image[slice_], (2, -3), (0, 1)), rel=1e-9)
    assert not np.array_equal(displaced[slice_], image[slice_])
    others = np.arange(len(image)) != slice_
    np.testing.assert_array_equal(displaced[others], image[others])


def test_the_grid_s_axes_are_the_ventricle_s(ventricle: VentricularMesh) -> None:
    """Septal, anterior and from the apex to the base; the margin is kept on every side."""
    grid: Grid = scene_of(ventricle, PLAIN).grid
    axes = LeftVentricularAxes.from_mesh(ventricle)
    np.testing.assert_array_equal(grid.direction, np.column_stack([axes.septal, axes.anterior, axes.axis]))
    index = grid.index(ventricle.points)
    edge = PLAN.margin / grid.spacing - 1.0
    assert (index.min(axis=0) >= edge).all()
    assert (index.max(axis=0) <= np.array(grid.size) - 1.0 - edge).all()
