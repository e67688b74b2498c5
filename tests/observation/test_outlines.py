"""Parametric ventricles in a motion in closed form, with a registration of known error."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid
from heartfit.observation.cine import compare_cine, left_ventricular_volumes, modified_simpson
from heartfit.observation.outlines import Outline, outlines, wall_points
from verification.specimen import SHAPE

FRAMES = 8
GRID = Grid(
    (120, 110, 6), np.array([2e-3, 2e-3, 9e-3]), np.array([-0.1, 0.1, -2e-3]), np.diag([1.0, -1.0, -1.0])
)
"""Slices from just below the base, which lies at z = 0, towards the apex."""

SQUEEZE = np.array([[-0.2, 0.05], [0.0, -0.1]])
"""Slope of the displacement in the plane, along i and j, in the last frame."""

SINKING = 3e-3
SHARE = np.linspace(0.0, 1.0, FRAMES)


@pytest.fixture(scope="module")
def surface() -> LabelledSurface:
    return SHAPE.surface()


@pytest.fixture(scope="module")
def motion() -> SliceMotion:
    """Registration that is exact in the plane."""
    j, i = np.meshgrid(np.arange(110.0), np.arange(120.0), indexing="ij")
    steps = (np.stack([i, j], axis=-1) - [50.0, 50.0]) @ SQUEEZE.T
    return SliceMotion(GRID, (0, 0), np.einsum("p,jic->pjic", SHARE, steps)[:, None].repeat(6, axis=1))


def displaced(surface: LabelledSurface, sinking: float = 0.0) -> np.ndarray:
    """The surface squeezed in the plane and sunk towards the apex."""
    index = GRID.index(surface.points)
    steps = np.zeros((FRAMES, len(index), 3))
    steps[..., :2] = SHARE[:, None, None] * ((index[:, :2] - 50.0) @ SQUEEZE.T)
    return surface.points + GRID.vectors(steps) - [0.0, 0.0, sinking] * SHARE[:, None, None]


def test_an_exact_registration_has_no_outline_errors(surface: LabelledSurface, motion: SliceMotion) -> None:
    compared = outlines(surface, displaced(surface), motion)
    assert {outline.surface for outline in compared} == {"lv_endo", "rv_endo", "epi"}
    for outline in compared:
        mean, far = outline.distance()
        assert max(mean.max(), far.max()) < 1e-9
        assert outline.carried_area == pytest.approx(outline.measured_area)
        squeezed = np.linalg.det(np.eye(2) + SHARE[:, None, None] * SQUEEZE)
        assert outline.measured_area == pytest.approx(outline.measured_area[0] * squeezed)
        assert outline.distance_at_rest()[-1] > 1e-3


def test_an_outline_that_is_a_circle_too_large_is_off_by_the_difference() -> None:
    angle = 2.0 * np.pi * np.linspace(0.0, 1.0, 600) ** 2
    circle = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(600)])
    segments = 0.02 * np.stack([circle[:-1], circle[1:]], axis=1)
    outline = Outline(
        "epi",
        0,
        np.array([0.0, 0.0, 1.0]),
        np.stack([segments, 1.1 * segments]),
        (segments, segments),
        np.ones(2),
    )
    mean, far = outline.distance()
    assert mean == pytest.approx([0.0, 2e-3], rel=1e-3)
    assert far == pytest.approx([0.0, 2e-3], rel=1e-3)
    assert outline.carried_area / outline.measured_area == pytest.approx([1.0, 1.21])


def test_the_mean_distance_is_along_the_outlines_however_finely_a_part_is_drawn() -> None:
    """A square of side 1 and one that is 0.2 higher, whose common side the second draws in a hundred pieces."""
    square = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    fine = np.linspace(square[0], square[1], 100, endpoint=False)
    higher = np.concatenate([fine, square[1:] * [1.0, 1.2, 1.0]])
    small, large = (np.stack([part, np.roll(part, -1, axis=0)], axis=1) for part in (square, higher))
    outline = Outline("epi", 0, np.array([0.0, 0.0, 1.0]), large[None], (small,), np.ones(1, bool))
    assert outline.distance()[0] == pytest.approx([(0.2 / 4.0 + 0.2 / 4.4) / 2.0])


def test_outlines_are_compared_while_the_plane_meets_no_valve_ring(
    surface: LabelledSurface, motion: SliceMotion
) -> None:
    """The rings start 2 mm on the basal side of slice 0 and pass it once they have sunk further."""
    compared = outlines(surface, displaced(surface, SINKING), motion)
    first = next(outline for outline in compared if outline.surface == "lv_endo" and outline.slice == 0)
    assert first.frames.tolist() == np.flatnonzero(SINKING * SHARE < 2e-3).tolist()
    assert np.isnan(first.measured_area[-1])
    assert np.isnan(first.distance()[0][-1])


def test_points_of_the_wall_are_followed_but_for_what_leaves_the_plane(
    surface: LabelledSurface, motion: SliceMotion
) -> None:
    right = wall_points(surface, displaced(surface, SINKING), motion, 2)
    assert right.carried.shape == (FRAMES, 24, 3)
    assert right.in_plane().max() < 1e-6
    assert right.through_plane() == pytest.approx(np.tile(SINKING * SHARE, (24, 1)).T, abs=1e-9)
    still = SliceMotion(GRID, (0, 0), np.zeros_like(motion.displacement))
    wrong = wall_points(surface, displaced(surface, SINKING), still, 2)
    expected = SHARE[:, None] * np.linalg.norm(
        GRID.vectors(np.pad((GRID.index(right.carried[0])[:, :2] - 50.0) @ SQUEEZE.T, ((0, 0), (0, 1)))),
        axis=1,
    )
    assert wrong.in_plane() == pytest.approx(expected, abs=1e-6)
    assert (np.abs(wrong.across()) <= wrong.in_plane() + 1e-12).all()


@pytest.mark.parametrize("depth", [0.25, 0.75])
def test_a_point_of_the_free_wall_lies_at_its_share_of_the_thickness(
    surface: LabelledSurface, motion: SliceMotion, depth: float
) -> None:
    """Away from the right ventricle, which is towards +x, the wall is 10 mm thick along the ellipsoid's normal."""
    points = wall_points(surface, displaced(surface), motion, 2, depth).carried[0]
    opposite = points[points[:, 0].argmin()]
    near = []
    for name in ("lv_endo", "epi"):
        triangles = surface.surfaces[name]
        index, weights = nearest_on_surface(opposite[None], surface.points, triangles)
        near.append(np.linalg.norm(weights[0] @ surface.points[triangles[index[0]]] - opposite))
    assert near[0] / sum(near) == pytest.approx(depth, abs=0.05)
    assert sum(near) == pytest.approx(SHAPE.wall_thickness, rel=0.05)


def test_simpsons_rule_is_exact_for_half_an_ellipsoid_but_for_the_trapezia() -> None:
    """A(z) = pi a^2 (1 - z^2/c^2) from the equator at z = 0 to z = l: the trapezia miss h^2/12 A'(l)."""
    a, c, length, count = 0.025, 0.06, 0.04, 6
    z, step = np.linspace(0.0, length, count, retstep=True)
    area = np.pi * a**2 * (1.0 - (z / c) ** 2)
    exact = np.pi * a**2 * (2.0 / 3.0 * c + length - length**3 / (3.0 * c**2))
    missed = step**2 / 12.0 * (-2.0 * np.pi * a**2 * length / c**2)
    assert modified_simpson(area, step, c, 0.0) == pytest.approx(exact + missed, rel=1e-12)
    assert modified_simpson(area, step, c, 0.01) == pytest.approx(exact + missed + 0.01 * area[-1], rel=1e-12)


def test_volumes_from_slices_are_those_of_the_surface(surface: LabelledSurface, motion: SliceMotion) -> None:
    """The base lies at k = 0 here, so slices run against the axis; 9 mm apart they miss about a per cent."""
    positions = displaced(surface)
    volumes = left_ventricular_volumes(surface, positions, GRID, outlines(surface, positions, motion))
    true = [Cavity.from_endocardium(surface, "lv_endo").volume(points) for points in positions]
    assert volumes["surface"] == pytest.approx(true)
    assert volumes["cut"] == pytest.approx(true, rel=0.02)
    for name in ("registered", "registered, ends at rest"):
        assert volumes[name] == pytest.approx(volumes["cut"], rel=1e-9)


def test_ends_at_rest_miss_the_descent_of_the_base(surface: LabelledSurface, motion: SliceMotion) -> None:
    sunk = 1.9e-3
    positions = displaced(surface, sunk)
    all_outlines = outlines(surface, positions, motion)
    volumes = left_ventricular_volumes(surface, positions, GRID, all_outlines)
    areas = [outline.carried_area[-1] for outline in all_outlines if outline.surface == "lv_endo"]
    gained = volumes["registered, ends at rest"][-1] - volumes["registered"][-1]
    assert gained == pytest.approx(sunk * areas[0] - 2.0 / 3.0 * sunk * areas[-1], rel=1e-6)


def test_a_comparison_holds_every_slice_and_refuses_mismatched_data(
    surface: LabelledSurface, motion: SliceMotion
) -> None:
    positions, times = displaced(surface), 0.1 * np.arange(FRAMES)
    cine = compare_cine(surface, positions, times, 0.8, motion)
    left = [outline.slice for outline in cine.outlines if outline.surface == "lv_endo"]
    assert [wall.slice for wall in cine.walls] == left
    assert cine.end_systole == FRAMES - 1
    with pytest.raises(InputError, match=r"\b8\b.*\b7\b"):
        compare_cine(surface, positions[1:], times[1:], 0.8, motion)
    with pytest.raises(InputError, match=r"slice.*left ventricle"):
        compare_cine(surface, positions + np.array([0.0, 0.0, 0.5]), times, 0.8, motion)
