"""Compiles the numerical kernels, which numba keeps on disk, before many jobs would at the same time."""

from dataclasses import replace

import numpy as np

from heartfit.beat import Beat
from heartfit.cohort.scanner import Contrast
from heartfit.cohort.scene import Scene
from heartfit.electrophysiology.eikonal import activation_times
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence
from heartfit.mechanics.body import FiniteElementBody
from heartfit.mechanisms.fibre_stiffening import FibreStiffening
from heartfit.registration.track import FreeForm, Tracking, track
from heartfit.simulation import Numerics, simulate
from heartfit.verification.block import cube


def compile_kernels() -> Beat:
    """The beat of a cube of muscle between two cavities, which runs every kernel, those of its images too."""
    block, heart = cube(2, 0.02), Heart() + FibreStiffening(modulus=0.0)
    times = activation_times(block.points, block.tets, np.asarray(block.fibres), {0: 0.0})
    block = replace(block, activation=times[block.tets].mean(axis=1))
    _image_and_track(block)
    return simulate(heart, FiniteElementBody(block, heart.muscle), Numerics(time_step=1e-2, max_beats=1))


def _image_and_track(block: VentricularMesh) -> Tracking:
    """Eight images of the cube at rest, and its mesh followed through them."""
    grid = Grid((12, 12, 12), np.full(3, 4e-3), np.full(3, -12e-3), np.eye(3))
    scene = Scene.of(
        block, np.array([1.0, 0.0, 0.0]), grid, Contrast(), np.zeros((12, 2)), np.random.default_rng(0)
    )
    image: Floats = scene.at(block.points).astype(np.float32)
    images = ImageSequence(grid, np.tile(image, (8, 1, 1, 1)), np.linspace(0.0, 0.7, 8), 0.8)
    return track(images, block, FreeForm())
