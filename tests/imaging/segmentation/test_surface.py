"""Surface reconstructed from the voxels of known ventricles."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from heartfit.core.errors import InputError
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface, euler_characteristic, rim_loops
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.segmentation.surface import wall_surface
from heartfit.imaging.segmentation.wall import Shaping
from heartfit.imaging.sequence import Grid
from tests.imaging.segmentation.conftest import PIXEL, STEP, axes


@pytest.fixture(scope="module")
def surface(segmentation: Segmentation) -> LabelledSurface:
    return wall_surface(segmentation)


def cavity(surface: LabelledSurface, name: str) -> float:
    return Cavity.from_endocardium(surface, name).volume(surface.points)


def distances(queries: np.ndarray, surface: LabelledSurface, name: str) -> np.ndarray:
    triangles = surface.surfaces[name]
    index, weights = nearest_on_surface(queries, surface.points, triangles)
    foot = np.einsum("qc,qcd->qd", weights, surface.points[triangles[index]])
    return np.linalg.norm(foot - queries, axis=1)


def test_cavities_and_wall_have_their_volumes(surface: LabelledSurface, ventricles: LabelledSurface) -> None:
    for name in ("lv_endo", "rv_endo"):
        assert cavity(surface, name) == pytest.approx(cavity(ventricles, name), rel=0.02)
    assert surface.volume() == pytest.approx(ventricles.volume(), rel=0.03)


def test_each_surface_is_where_it_was_to_less_than_a_pixel(
    surface: LabelledSurface, ventricles: LabelledSurface
) -> None:
    for name in ("lv_endo", "rv_endo", "epi"):
        away = distances(surface.points[np.unique(surface.surfaces[name])[::4]], ventricles, name)
        assert away.mean() < 0.5 * PIXEL
        assert np.quantile(away, 0.95) < PIXEL


def test_the_wall_is_a_ball_with_one_flat_opening_of_each_cavity(surface: LabelledSurface) -> None:
    assert euler_characteristic(surface.triangles) == 2
    assert [len(rim_loops(surface.surfaces[name])) for name in ("lv_endo", "rv_endo", "epi")] == [1, 1, 1]
    base = surface.points[np.unique(surface.surfaces["base"])] @ axes()[:, 2]
    np.testing.assert_allclose(base, 0.0, atol=1e-9)


def test_a_wall_that_is_not_segmented_has_the_stated_thickness(segmentation: Segmentation) -> None:
    parts = {name: mask for name, mask in segmentation.parts.items() if name != "rv_wall"}
    for thickness in (3e-3, 4.5e-3):
        surface = wall_surface(Segmentation(segmentation.grid, parts), Shaping(right_wall=thickness))
        free = surface.points[np.unique(surface.surfaces["epi"])[::12]]
        to_left, to_right = (distances(free, surface, name) for name in ("lv_endo", "rv_endo"))
        over_right = to_right < 0.7 * to_left
        assert np.median(to_right[over_right]) == pytest.approx(thickness, abs=0.3e-3)


def test_slices_may_be_numbered_either_way(segmentation: Segmentation, surface: LabelledSurface) -> None:
    grid = segmentation.grid
    last = grid.points(np.array([0.0, 0.0, grid.size[2] - 1.0]))
    turned = grid.direction * [1.0, 1.0, -1.0]
    backwards = Segmentation(
        replace(grid, origin=last, direction=turned),
        {name: mask[::-1] for name, mask in segmentation.parts.items()},
    )
    assert wall_surface(backwards).volume() == pytest.approx(surface.volume(), rel=1e-9)


def test_the_base_is_cut_where_it_is_stated(segmentation: Segmentation, surface: LabelledSurface) -> None:
    lower = wall_surface(segmentation, Shaping(above_base=0.0))
    height = (lower.points @ axes()[:, 2]).max()
    assert height == pytest.approx(-0.5 * STEP, abs=1e-9)
    assert cavity(lower, "lv_endo") < cavity(surface, "lv_endo")


def test_a_wall_with_a_hole_is_refused(segmentation: Segmentation, grid: Grid) -> None:
    wall = segmentation.parts["lv_wall"].copy()
    wall[6, :, 40:] = False
    with pytest.raises(InputError, match=r"slice 6, \d+ %"):
        wall_surface(Segmentation(grid, {**segmentation.parts, "lv_wall": wall}))


def test_inflow_and_outflow_of_the_right_ventricle_leave_one_opening(segmentation: Segmentation) -> None:
    """Its last slice is parted; the smaller part ends below it."""
    right = segmentation.parts["rv_cavity"].copy()
    last = int(np.flatnonzero(right.any(axis=(1, 2)))[-1])
    rows = np.flatnonzero(right[last].any(axis=1))
    right[last, rows[len(rows) // 3] : rows[len(rows) // 3] + 4] = False
    surface = wall_surface(Segmentation(segmentation.grid, {**segmentation.parts, "rv_cavity": right}))
    assert euler_characteristic(surface.triangles) == 2
    assert len(rim_loops(surface.surfaces["rv_endo"])) == 1


def test_gaps_enclosed_in_a_slice_are_wall(segmentation: Segmentation, surface: LabelledSurface) -> None:
    """A pit between the parts, as between aorta and right ventricle, would be a tunnel."""
    wall = segmentation.parts["lv_wall"].copy()
    j, i = np.unravel_index(distance_transform_edt(wall[11]).argmax(), wall[11].shape)
    wall[10:, j - 1 : j + 2, i - 1 : i + 2] = False
    filled = wall_surface(Segmentation(segmentation.grid, {**segmentation.parts, "lv_wall": wall}))
    assert filled.volume() == pytest.approx(surface.volume(), rel=2e-3)
