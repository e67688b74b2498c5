"""What a scanner sees at one instant of a beating heart: lung, fat, blood and muscle, on a fine grid.

The muscle carries its texture along. Beyond the valves the blood goes on into atria and great vessels: from each lid
of a cavity to where it was at end diastole, a little further up, so that it lengthens as the base descends. The valve
plane is seen too, as in a real cine: leaflets lie across each ring, and fat in the groove upon the muscle of the base.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import gaussian_filter

from heartfit.cohort.scanner import Contrast
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.topology import directed_edges
from heartfit.imaging.grid import Grid
from heartfit.imaging.raster import paint_inside, paint_wall

ATRIUM, FAT, LEAFLET = 30e-3, 5e-3, 3e-3
"""How far blood, fat of the groove and leaflets reach beyond the valve plane, m."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A heart in its surroundings, seen on ``grid``; the samples of slice k are displaced by shift[k] (2,), in voxels.

    mesh: at end diastole; up (3,) from apex to base; muscle, lung (k,j,i): their brightness with its texture, muscle's
    where it lay at end diastole.
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
        """The scene of a mesh at end diastole, with textures drawn from ``rng``."""
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
        return tuple(Cavity.of(self.mesh, f"{side}_endo") for side in ("lv", "rv"))

    def at(self, positions: Floats) -> Floats:
        """Brightness (k,j,i) with the mesh's nodes at ``positions`` (n,3), m."""
        image = self.lung.copy()
        self._fill(image, positions, self.mesh.surfaces["base"], positions + FAT * self.up, self.contrast.fat)
        for cavity in self._cavities:
            now, first = cavity.corners(positions), cavity.corners(self.mesh.points)
            lids = cavity.lids % len(now)
            self._fill(image, now, lids, first + ATRIUM * self.up, self.contrast.blood)
            self._paint(image, now, cavity.triangles % len(now), self.contrast.blood)
            self._fill(image, now, lids, now + LEAFLET * self.up, self.contrast.leaflets)
        places, material = self.grid.index(positions), self.grid.index(self.mesh.points)
        paint_wall(image, places, self.mesh.tets, material, self.muscle, self.shift)
        return image

    def _fill(self, image: Floats, bottom: Floats, patch: Integers, top: Floats, brightness: float) -> None:
        """Paints what lies between a patch of triangles and the same patch with its corners elsewhere."""
        self._paint(image, np.vstack([bottom, top]), prism(patch, len(bottom)), brightness)

    def _paint(self, image: Floats, corners: Floats, triangles: Integers, brightness: float) -> None:
        paint_inside(image, self.grid.index(corners), triangles, brightness, self.shift)


def prism(patch: Integers, above: int) -> Integers:
    """The closed surface between a patch of triangles (k,3) and its image, its corners numbered ``above`` more."""
    edges = directed_edges(patch)
    present = set(map(tuple, edges.tolist()))
    rim = np.array([(a, b) for a, b in edges.tolist() if (b, a) not in present])
    a, b = rim.T
    sides = [np.column_stack([a, b, b + above]), np.column_stack([a, b + above, a + above])]
    return np.vstack([patch[:, ::-1], patch + above, *sides])


def _texture(shape: tuple[int, int, int], sigma: Floats, rng: np.random.Generator) -> Floats:
    """A smooth random field of mean 0 and standard deviation 1."""
    field = gaussian_filter(rng.standard_normal(shape), sigma, mode="wrap")
    normal: Floats = (field - field.mean()) / field.std()
    return normal
