"""Data of the viewer: the heart to a tenth of a millimetre."""

import numpy as np
import pytest

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.results.report.surface import (
    INSIDE,
    OUTSIDE,
    QUANTUM,
    pack,
    packed_positions,
    packed_surface,
    unpack,
)
from tests.results.report.small_report import FRAMES
from tests.results.report.small_report import beating as shrinking


def test_numbers_are_unchanged_by_packing() -> None:
    numbers = np.array([0, -1, 70_000, -2_000_000])
    assert unpack(pack(numbers)).tolist() == numbers.tolist()


@pytest.mark.parametrize(("part", "names"), [("outside", OUTSIDE), ("inside", INSIDE)])
def test_triangles_keep_their_size_through_the_beat(
    ventricle: VentricularMesh, part: str, names: tuple[str, ...]
) -> None:
    """Distances are invariant to the frame: those of the page equal those of the mesh."""
    motion = shrinking(ventricle, 0.8)
    corners = unpack(packed_surface(ventricle)[part]["triangles"]).reshape(3, -1).T
    steps = unpack(packed_positions(ventricle, motion.positions)[part]).reshape(FRAMES, 3, -1)
    places = QUANTUM * np.cumsum(steps, axis=0).swapaxes(1, 2)
    faces = np.vstack([ventricle.surfaces[name] for name in names])
    for phase in (0, 3):
        shown, true = places[phase][corners], motion.positions[phase][faces]
        sides = np.linalg.norm(shown - np.roll(shown, 1, axis=1), axis=2)
        assert sides == pytest.approx(
            np.linalg.norm(true - np.roll(true, 1, axis=1), axis=2), abs=2 * QUANTUM
        )


def test_the_axes_are_those_of_the_ventricle(ventricle: VentricularMesh) -> None:
    """x away from the septum, z to the base."""
    axes = LeftVentricularAxes.from_mesh(ventricle)
    turned = np.array(
        [ventricle.points, ventricle.points + 0.01 * axes.axis, ventricle.points + 0.01 * axes.septal]
    )
    steps = QUANTUM * unpack(packed_positions(ventricle, turned)["outside"]).reshape(3, 3, -1).mean(axis=2)
    assert steps[1] == pytest.approx([0.0, 0.0, 0.01], abs=QUANTUM)
    assert steps[2] == pytest.approx([-0.01, 0.0, -0.01], abs=QUANTUM)


def test_a_triangle_has_the_segment_of_the_wall_behind_it(ventricle: VentricularMesh) -> None:
    segments = set(unpack(packed_surface(ventricle)["outside"]["segment"]).tolist())
    assert segments <= set(np.asarray(ventricle.segments).tolist())
    assert 0 in segments
    assert len(segments) > 10
