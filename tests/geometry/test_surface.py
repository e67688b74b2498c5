"""Closed surfaces: their volume, and the refusal of others."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.surface import LabelledSurface

POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]])
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
LABELS = np.array(["lv_endo", "rv_endo", "base", "epi"])


def test_a_corner_of_a_box_holds_a_sixth_of_it() -> None:
    surface = LabelledSurface(POINTS + 5.0, TRIANGLES, LABELS)
    assert surface.volume() == pytest.approx(1.0)
    assert surface.surfaces["epi"].tolist() == [[1, 2, 3]]


@pytest.mark.parametrize(
    ("triangles", "labels", "what"),
    [
        (TRIANGLES[:3], LABELS[:3], r"\b3 edges"),
        (np.vstack([TRIANGLES[:3], TRIANGLES[3:, ::-1]]), LABELS, "oriented"),
        (TRIANGLES[:, ::-1], LABELS, "outward"),
        (np.vstack([TRIANGLES, TRIANGLES]), np.tile(LABELS, 2), "manifold"),
        (TRIANGLES, np.where(LABELS == "epi", "pericardium", LABELS), "pericardium"),
    ],
)
def test_a_surface_that_does_not_bound_a_wall_is_refused(
    triangles: np.ndarray, labels: np.ndarray, what: str
) -> None:
    with pytest.raises(InputError, match=what):
        LabelledSurface(POINTS, triangles, labels)
