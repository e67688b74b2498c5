"""A beating mesh and images of its size, for tests of pictures that show both."""

import numpy as np

from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.sequence import Grid, ImageSequence

FRAMES, SYSTOLE, PERIOD = 8, 3, 0.8


def beating(mesh: VentricularMesh, frames: int = FRAMES) -> Motion:
    """The mesh shrinks towards its centre, most in one phase."""
    size = 1.0 - 0.2 * np.exp(-((np.arange(frames) - SYSTOLE * frames / FRAMES) ** 2))
    size[0] = 1.0
    centre = mesh.points.mean(axis=0)
    positions = centre + size[:, None, None] * (mesh.points - centre)
    return Motion(np.arange(frames) * PERIOD / frames, PERIOD, positions)


def images(mesh: VentricularMesh, frames: int = FRAMES) -> ImageSequence:
    """Noise in voxels of 4 mm about the mesh."""
    low = mesh.points.min(axis=0) - 0.02
    size = (np.ptp(mesh.points, axis=0) + 0.04) // 4e-3
    grid = Grid((int(size[0]), int(size[1]), int(size[2])), np.full(3, 4e-3), low, np.eye(3))
    voxels = np.random.default_rng(0).random((frames, *grid.shape)).astype(np.float32)
    return ImageSequence(grid, voxels, np.arange(frames) * PERIOD / frames, PERIOD)
