"""Synthetic cine: the images of a simulated beat.

A voxel is the mean of what lies in it, over the thickness of its slice and the time that a frame takes (partial volume
and temporal blur); its noise is Rician. The motion itself goes no further than here.
"""

from collections.abc import Iterator

import numpy as np

from heartfit.cohort.scan_plan import ScanPlan
from heartfit.cohort.scanner import Scanner
from heartfit.cohort.scene import Scene
from heartfit.geometry.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.sequence import ImageSequence


def image_beat(mesh: VentricularMesh, motion: Motion, scanner: Scanner, seed: int) -> ImageSequence:
    """The cine of a mesh at end diastole and its motion, phase 0 at the trigger.

    Displacements of the slices, textures and noise are drawn from the seed, in this order.
    """
    rng = np.random.default_rng(seed)
    axes = LeftVentricularAxes.of(mesh)
    plan = ScanPlan.about(mesh, axes, scanner)
    shift = scanner.breath_hold_shift * rng.standard_normal((plan.grid.size[2], 2)) / plan.fine.spacing[:2]
    shift = np.repeat(shift, plan.pitch, axis=0)
    scene = Scene.of(mesh, axes.axis, plan.fine, scanner.contrast, shift, rng)
    times = np.arange(scanner.frames) * motion.period / scanner.frames
    noise = scanner.contrast.blood / scanner.signal_to_noise
    frames = []
    for instants in _instants(times, scanner):
        clean = np.mean([plan.mean(scene.at(motion.at(instant))) for instant in instants], axis=0)
        frames.append(_rician(clean, noise, rng))
    return ImageSequence(plan.grid, np.array(frames), times, motion.period)


def _instants(times: Floats, scanner: Scanner) -> Iterator[Floats]:
    """The instants (s,) that each frame averages: the midpoints of equal parts of its window."""
    parts = (np.arange(scanner.subframes) + 0.5) / scanner.subframes - 0.5
    return (time + scanner.window * parts for time in times)


def _rician(clean: Floats, noise: float, rng: np.random.Generator) -> Floats:
    """Magnitude of the signal with Gaussian noise in both channels, in single precision as files hold it."""
    real, imaginary = noise * rng.standard_normal((2, *clean.shape))
    magnitude: Floats = np.hypot(clean + real, imaginary).astype(np.float32)
    return magnitude
