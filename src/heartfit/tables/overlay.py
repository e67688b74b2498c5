"""A mesh drawn over the images that it was carried by."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.image import AxesImage

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.sequence import ImageSequence
from heartfit.imaging.view import View, views
from heartfit.observation.volumes import cavity_volumes

OUTLINES = {"lv_endo": ("left endocardium", "#D55E00"), "rv_endo": ("right endocardium", "#56B4E9")}
OUTLINES |= {"epi": ("epicardium", "#F0E442")}
PIXEL = 0.7e-3
"""Width of a pixel of the pictures, m."""

WHITE = 99.5
"""Percentile of the brightness at end diastole, in the view, that is drawn white."""

SAME_TIME = 1e-3
"""Difference of a phase from its frame that is rounding, over the period."""


@dataclass(frozen=True, eq=False)
class Overlay:
    """Images and the motion of a mesh, phase for phase; raises InputError if they are not of the same times."""

    sequence: ImageSequence
    mesh: VentricularMesh
    motion: Motion

    def __post_init__(self) -> None:
        frames, phases = self.sequence.times, self.motion.times
        if frames.shape != phases.shape or np.abs(frames - phases).max() > SAME_TIME * self.motion.period:
            raise InputError(
                f"overlay: {len(phases)} phases of the motion, {len(frames)} frames of the images; expected the same "
                "times: take the images that the motion was registered from"
            )

    @cached_property
    def volumes(self) -> Mapping[str, Floats]:
        """Volume (p,) in m^3 of the left and right cavity, by "lv" and "rv"."""
        curves = cavity_volumes(self.mesh, self.motion)
        return {side: curves[f"{side}_volume"].values for side in ("lv", "rv")}

    @cached_property
    def views(self) -> Mapping[str, View]:
        """Planes through the left ventricle, by what they are."""
        return views(self.sequence.grid, self.mesh)


class Panel:
    """One view of an overlay, drawn into axes, in any phase."""

    def __init__(self, axes: Axes, overlay: Overlay, view: View) -> None:
        self.overlay, self.view = overlay, view
        left, bottom, right, top = 1e3 * np.array([*view.low, *view.high])
        self.image: AxesImage = axes.imshow(
            self._picture(0),
            cmap="gray",
            origin="lower",
            extent=(left, right, bottom, top),
            interpolation="nearest",
        )
        self.image.set_clim(0.0, float(np.percentile(self._picture(0), WHITE)))
        self.lines = {
            name: LineCollection([], colors=colour, linewidths=1.2) for name, (_, colour) in OUTLINES.items()
        }
        for line in self.lines.values():
            axes.add_collection(line, autolim=False)
        axes.set_axis_off()

    def show(self, phase: int) -> None:
        """The image and where the plane cuts the mesh in this phase, in mm from the view's origin."""
        self.image.set_data(self._picture(phase))
        points = self.overlay.motion.positions[phase]
        for name, line in self.lines.items():
            line.set_segments(list(1e3 * self.view.outline(points, self.overlay.mesh.surfaces[name])))

    def _picture(self, phase: int) -> Floats:
        sequence = self.overlay.sequence
        return self.view.picture(sequence.voxels[phase], sequence.grid, PIXEL)
