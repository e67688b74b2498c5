"""Real short-axis images against the measured surface: outlines, points of the wall and volume together."""

from collections.abc import Mapping
from dataclasses import dataclass

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.surface import LabelledSurface
from heartfit.observation.curve import Curve
from heartfit.observation.outlines import Outline, outlines
from heartfit.observation.short_axis_volume import left_volumes
from heartfit.observation.wall_points import WallPoints, wall_points
from heartfit.registration.slices import SliceMotion


@dataclass(frozen=True, eq=False)
class CineComparison:
    """What registration found in short-axis images, and what the measured surface says.

    outlines: one for each surface and slice; walls: points of the wall in each slice that holds the left ventricle;
    volumes: the left ventricle's, see heartfit.observation.short_axis_volume; end_systole: the frame in which the
    surface's is smallest.
    """

    outlines: list[Outline]
    walls: list[WallPoints]
    volumes: Mapping[str, Curve]
    end_systole: int


def compare_cine(
    surface: LabelledSurface, positions: Floats, times: Floats, period: float, motion: SliceMotion
) -> CineComparison:
    """Everything that can be compared.

    surface: the measured one in the first frame; positions (p,n,3) m: its points in the frames of the motion; times
    (p,) s; period s.

    Raises InputError for another number of frames, and if no slice cuts the left ventricle below its valves.
    """
    if len(positions) != len(motion.displacement):
        raise InputError(
            f"cine: {len(motion.displacement)} frames, {len(positions)} phases of the measured surface; "
            "expected one for each: register the images that the surface was fitted to"
        )
    found = outlines(surface, positions, motion)
    slices = [outline.slice for outline in found if outline.surface == "lv_endo"]
    if not slices:
        raise InputError(
            "cine: no slice cuts the left ventricle below its valves; "
            "expected short-axis images of the measured heart in the same coordinates"
        )
    walls = [wall_points(surface, positions, motion, k) for k in slices]
    volumes = left_volumes(surface, positions, motion.grid, found)
    curves = {name: Curve.of_volume(times, values, period) for name, values in volumes.items()}
    return CineComparison(found, walls, curves, int(volumes["surface"].argmin()))
