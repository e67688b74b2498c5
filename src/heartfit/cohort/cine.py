"""Synthetic cine: the images of a simulated beat.

A voxel is the mean of what lies in it, over the thickness of its slice and the time that a frame takes (partial volume
and temporal blur); its noise is Rician. The motion itself goes no further than here.
"""

from collections.abc import Iterator

import numpy as np

from heartfit.cohort.scanner import Scanner
from heartfit.cohort.scene import Scene
from heartfit.geometry.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence


def image_beat(mesh: VentricularMesh, motion: Motion, scanner: Scanner, seed: int) -> ImageSequence:
    """The cine of a mesh at end diastole and its motion, phase 0 at the trigger."""
    rng = np.random.default_rng(seed)
    axes = LeftVentricularAxes.of(mesh)
    plan = _Plan.of(mesh, axes, scanner)
    shift = (
        scanner.breath_hold_shift / scanner.voxel * plan.across * rng.standard_normal((plan.grid.size[2], 2))
    )
    scene = Scene.of(mesh, axes.axis, plan.fine, scanner.contrast, np.repeat(shift, plan.pitch, axis=0), seed)
    times = np.arange(scanner.frames) * motion.period / scanner.frames
    frames = [plan.average(scene, motion, instants) for instants in _instants(times, scanner)]
    noise = scanner.contrast.blood / scanner.signal_to_noise
    return ImageSequence(plan.grid, _rician(np.array(frames), noise, rng), times, motion.period)


class _Plan:
    """The voxels of a scan about the heart, and the finer ones that each of them averages.

    across, pitch: fine voxels in a voxel along i and j, and from slice to slice; inside: those within a slice.
    """

    def __init__(self, low: Floats, high: Floats, axes: Floats, scanner: Scanner) -> None:
        step = scanner.slice_thickness + scanner.slice_gap
        self.across = max(1, round(scanner.voxel / scanner.subvoxel))
        self.pitch = max(1, round(step / scanner.subvoxel))
        self.inside = max(1, round(self.pitch * scanner.slice_thickness / step))
        spacing = np.array([scanner.voxel, scanner.voxel, step])
        size = np.ceil((high - low) / spacing).astype(int)
        parts = np.array([self.across, self.across, self.pitch])
        averaged = np.array([self.across, self.across, self.inside])
        origin = low + 0.5 * spacing / parts
        self.fine = _grid(size * parts, spacing / parts, origin, axes)
        self.grid = _grid(size, spacing, origin + 0.5 * (averaged - 1) * spacing / parts, axes)

    @classmethod
    def of(cls, mesh: VentricularMesh, axes: LeftVentricularAxes, scanner: Scanner) -> "_Plan":
        """Short-axis slices that hold the mesh and a margin about it."""
        directions = np.column_stack([axes.septal, axes.anterior, axes.axis])
        along = mesh.points @ directions
        return cls(
            along.min(axis=0) - scanner.margin, along.max(axis=0) + scanner.margin, directions, scanner
        )

    def average(self, scene: Scene, motion: Motion, instants: Floats) -> Floats:
        """Brightness (k,j,i) of a frame that is the mean of the scene at some instants."""
        fine = np.mean([scene.at(motion.at(instant)) for instant in instants], axis=0)
        i, j, k = self.grid.size
        parts = fine.reshape(k, self.pitch, j, self.across, i, self.across)[:, : self.inside]
        mean: Floats = parts.mean(axis=(1, 3, 5))
        return mean


def _grid(size: Floats, spacing: Floats, low: Floats, axes: Floats) -> Grid:
    i, j, k = map(int, size)
    return Grid((i, j, k), spacing, axes @ low, axes)


def _instants(times: Floats, scanner: Scanner) -> Iterator[Floats]:
    """The instants (s,) that each frame averages: the midpoints of equal parts of its window."""
    parts = (np.arange(scanner.subframes) + 0.5) / scanner.subframes - 0.5
    return (time + scanner.window * parts for time in times)


def _rician(clean: Floats, noise: float, rng: np.random.Generator) -> Floats:
    """Magnitude of the signal with Gaussian noise in both channels, in single precision as files hold it."""
    real = clean + noise * rng.standard_normal(clean.shape)
    magnitude: Floats = np.hypot(real, noise * rng.standard_normal(clean.shape)).astype(np.float32)
    return magnitude
