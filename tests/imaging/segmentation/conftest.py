"""Parametric ventricles, painted into short-axis images as exact segmentations."""

import numpy as np
import pytest

from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.segmentation.surface import segment_surface
from heartfit.imaging.segmentation.wall import TO_APEX, TO_RIGHT_VENTRICLE
from heartfit.imaging.sequence import Grid

PIXEL, STEP, SLICES = 1.6e-3, 8e-3, 16


def axes() -> np.ndarray:
    """Directions in the patient of the x, y and z of parametric ventricles."""
    z = -TO_APEX / np.linalg.norm(TO_APEX)
    x = TO_RIGHT_VENTRICLE - (TO_RIGHT_VENTRICLE @ z) * z
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


@pytest.fixture(scope="session")
def ventricles() -> LabelledSurface:
    """Ventricles as they lie in a patient; their base is in the origin."""
    wall = ParametricVentricles(150e-6, 10e-3, 1.8, 160e-6, 3.5e-3).surface()
    return LabelledSurface(wall.points @ axes().T, wall.triangles, wall.labels)


@pytest.fixture(scope="session")
def grid() -> Grid:
    """Short-axis slices of which the base is midway between two."""
    first = axes() @ np.array([-0.055, -0.06, (3.5 - SLICES) * STEP])
    return Grid((90, 75, SLICES), np.array([PIXEL, PIXEL, STEP]), first, axes())


@pytest.fixture(scope="session")
def segmentation(ventricles: LabelledSurface, grid: Grid) -> Segmentation:
    return segment_surface(ventricles, grid)
