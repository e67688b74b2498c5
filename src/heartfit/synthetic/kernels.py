"""Compilation of the numerical kernels, which numba caches on disk, before many jobs need them at the same time."""

from dataclasses import replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.cube import cube
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.eikonal import activation_times
from heartfit.heart.beat import Beat
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.imaging.registration.track import FreeForm, Tracking, track
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.mechanisms.fibre_stiffening import FibreStiffening
from heartfit.synthetic.cine import Scene
from heartfit.synthetic.scanner import Contrast


def compile_kernels() -> Beat:
    """Simulate, image and track a cube of muscle between two cavities, which runs every kernel; return its beat."""
    block, heart = cube(2, 0.02), Heart() + FibreStiffening(modulus=0.0)
    times = activation_times(block.points, block.tets, np.asarray(block.fibres), {0: 0.0})
    block = replace(block, activation=times[block.tets].mean(axis=1))
    _image_and_track(block)
    return simulate(heart, FiniteElementBody(block, heart.muscle), Numerics(time_step=1e-2, max_beats=1))


def _image_and_track(block: VentricularMesh) -> Tracking:
    """Track the mesh of the cube through eight images of the cube at rest."""
    grid = Grid((12, 12, 12), np.full(3, 4e-3), np.full(3, -12e-3), np.eye(3))
    scene = Scene.of(
        block, np.array([1.0, 0.0, 0.0]), grid, Contrast(), np.zeros((12, 2)), np.random.default_rng(0)
    )
    image: Floats = scene.at(block.points).astype(np.float32)
    images = ImageSequence(grid, np.tile(image, (8, 1, 1, 1)), np.linspace(0.0, 0.7, 8), 0.8)
    return track(images, block, FreeForm())
