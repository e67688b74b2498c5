"""Synthetic cine images of a simulated beat, and the error of a registration on them.

A scene is the heart at one instant on a fine grid: lung, fat, blood and muscle. The muscle carries its texture along.
Beyond the valves the blood continues into atria and great vessels: from each lid of a cavity to its end-diastolic
position, shifted upwards, so that this column lengthens as the base descends. The valve plane is visible as in a real
cine: leaflets lie across each ring, and fat of the groove lies on the muscle of the base.

A voxel is the mean brightness over its area, the thickness of its slice and the time of its frame (partial volume and
temporal blur); its noise is Rician. The true motion enters the images only, never the registration.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import product

import numpy as np
from scipy.ndimage import gaussian_filter

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.surface import directed_edges
from heartfit.heart.beat import Beat
from heartfit.imaging.raster import paint_inside, paint_wall
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.observation.beat import beat_curves
from heartfit.observation.comparison import Comparison, compare_motions
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.synthetic.scanner import Catheter, Contrast, Scanner


class ScanPlan:
    """Slices across ``axes`` (3, 3), columns i, j, k, that fill the box from ``low`` to ``high`` (3,) [m].

    grid, fine: voxels of the scan and fine voxels; across, pitch: fine voxels per voxel along i and j, and per slice
    distance; inside: fine voxels along k within a slice, the others lie in the gap.
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
    def about(cls, mesh: VentricularMesh, axes: LeftVentricularAxes, scanner: Scanner) -> "ScanPlan":
        """Plan short-axis slices that contain the mesh and a margin around it."""
        directions = np.column_stack([axes.septal, axes.anterior, axes.axis])
        along = mesh.points @ directions
        return cls(
            along.min(axis=0) - scanner.margin, along.max(axis=0) + scanner.margin, directions, scanner
        )

    def mean(self, image: Floats) -> Floats:
        """Average an image on the fine voxels over each voxel of the scan (k, j, i)."""
        starts = product(range(self.inside), range(self.across), range(self.across))
        parts = [image[k :: self.pitch, j :: self.across, i :: self.across] for k, j, i in starts]
        mean: Floats = reduce(np.add, parts) / len(parts)
        return mean


def _grid(size: Floats, spacing: Floats, low: Floats, axes: Floats) -> Grid:
    i, j, k = map(int, size)
    return Grid((i, j, k), spacing, axes @ low, axes)


ATRIUM, FAT, LEAFLET = 30e-3, 5e-3, 3e-3
"""Extent of atrial blood, fat of the groove and leaflets beyond the valve plane [m]."""


@dataclass(frozen=True, eq=False)
class Scene:
    """Heart and surrounding tissue on ``grid``; the samples of slice k are displaced by shift[k] (2,) [voxels].

    mesh: at end diastole; up (3,): unit vector from apex to base; muscle, lung (k, j, i): brightness with texture, that
    of the muscle at its end-diastolic position.
    """

    mesh: VentricularMesh
    up: Floats
    grid: Grid
    contrast: Contrast
    muscle: Floats
    lung: Floats
    shift: Floats

    @classmethod
    def of(
        cls,
        mesh: VentricularMesh,
        up: Floats,
        grid: Grid,
        contrast: Contrast,
        shift: Floats,
        rng: np.random.Generator,
    ) -> "Scene":
        """Create the scene of a mesh at end diastole, with textures drawn from ``rng``."""
        sigma = contrast.texture_length / grid.spacing[::-1]
        muscle, lung = (
            brightness * (1.0 + amount * _texture(grid.shape, sigma, rng))
            for brightness, amount in (
                (contrast.muscle, contrast.muscle_texture),
                (contrast.lung, contrast.lung_texture),
            )
        )
        return cls(mesh, up, grid, contrast, muscle, lung, shift)

    @cached_property
    def _cavities(self) -> tuple[Cavity, ...]:
        return tuple(Cavity.from_endocardium(self.mesh, f"{side}_endo") for side in ("lv", "rv"))

    def at(self, positions: Floats) -> Floats:
        """Return the brightness (k, j, i) with the nodes of the mesh at ``positions`` (n, 3) [m]."""
        image = self.lung.copy()
        self._fill(image, positions, self.mesh.surfaces["base"], positions + FAT * self.up, self.contrast.fat)
        for cavity in self._cavities:
            current, initial = cavity.corners(positions), cavity.corners(self.mesh.points)
            lids = cavity.lids % len(current)
            self._fill(image, current, lids, initial + ATRIUM * self.up, self.contrast.blood)
            self._paint(image, current, cavity.triangles % len(current), self.contrast.blood)
            self._fill(image, current, lids, current + LEAFLET * self.up, self.contrast.leaflets)
        places, material = self.grid.index(positions), self.grid.index(self.mesh.points)
        paint_wall(image, places, self.mesh.tets, material, self.muscle, self.shift)
        return image

    def _fill(self, image: Floats, bottom: Floats, patch: Integers, top: Floats, brightness: float) -> None:
        """Paint the volume between a patch of triangles and its image with corners at ``top``."""
        self._paint(image, np.vstack([bottom, top]), prism(patch, len(bottom)), brightness)

    def _paint(self, image: Floats, corners: Floats, triangles: Integers, brightness: float) -> None:
        paint_inside(image, self.grid.index(corners), triangles, brightness, self.shift)


def prism(patch: Integers, above: int) -> Integers:
    """Return the closed surface (m, 3) between a patch of triangles (k, 3) and its image, whose corners have numbers
    larger by ``above``.
    """
    edges = directed_edges(patch)
    present = set(map(tuple, edges.tolist()))
    rim = np.array([(a, b) for a, b in edges.tolist() if (b, a) not in present])
    a, b = rim.T
    sides = [np.column_stack([a, b, b + above]), np.column_stack([a, b + above, a + above])]
    return np.vstack([patch[:, ::-1], patch + above, *sides])


def _texture(shape: tuple[int, int, int], sigma: Floats, rng: np.random.Generator) -> Floats:
    """Draw a smooth random field of mean 0 and standard deviation 1."""
    field = gaussian_filter(rng.standard_normal(shape), sigma, mode="wrap")
    normal: Floats = (field - field.mean()) / field.std()
    return normal


def image_beat(mesh: VentricularMesh, motion: Motion, scanner: Scanner, seed: int) -> ImageSequence:
    """Return the cine of a mesh at end diastole and its motion, phase 0 at the trigger.

    Slice displacements, textures and noise are drawn from the seed, in this order.
    """
    rng = np.random.default_rng(seed)
    axes = LeftVentricularAxes.from_mesh(mesh)
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
    """Yield per frame the instants (s,) [s] that it averages: midpoints of equal parts of its window."""
    parts = (np.arange(scanner.subframes) + 0.5) / scanner.subframes - 0.5
    return (time + scanner.window * parts for time in times)


def _rician(clean: Floats, noise: float, rng: np.random.Generator) -> Floats:
    """Return the magnitude of the signal with Gaussian noise in both channels, in single precision like files."""
    real, imaginary = noise * rng.standard_normal((2, *clean.shape))
    magnitude: Floats = np.hypot(clean + real, imaginary).astype(np.float32)
    return magnitude


def try_acquisition(
    mesh: VentricularMesh,
    motion: Motion,
    beat: Beat,
    scanner: Scanner,
    registration: FreeForm,
    catheter: Catheter,
    features: Mapping[str, CurveFeatures],
    seed: int,
) -> Comparison:
    """Image, register and record a beat, and compare the result with the truth.

    mesh: at end diastole; motion: of its nodes; features: operators of "lv_volume" and "lv_pressure".

    The registered mesh is the simulated one, so that the comparison contains the error of images and registration, but
    not that of another mesh of the same wall.
    """
    images = image_beat(mesh, motion, scanner, seed)
    registered = track(images, mesh, registration).motion
    pressure = beat_curves(beat)["lv_pressure"]
    recorded = Curve.of_pressure(*catheter.record(beat, seed))
    return compare_motions(mesh, motion.resample(images.times), registered, features, (pressure, recorded))
