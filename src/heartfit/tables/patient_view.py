"""A plane through the images of a patient, with the letters of where its sides lie."""

import numpy as np
from matplotlib.axes import Axes

from heartfit.geometry.arrays import Floats
from heartfit.imaging.sequence import ImageSequence
from heartfit.imaging.view import View
from heartfit.tables.overlay import PIXEL, WHITE

TOWARDS = (("R", "L"), ("A", "P"), ("F", "H"))
"""The patient's right and left, front and back, feet and head, along the scanner's axes."""


def draw_view(axes: Axes, images: ImageSequence, view: View, frame: int) -> None:
    """The images in a view, mm from its origin, with the letters of where its sides lie."""
    left, bottom, right, top = 1e3 * np.array([*view.low, *view.high])
    bright = np.percentile(view.picture(images.voxels[0], images.grid, PIXEL), WHITE)
    picture = view.picture(images.voxels[frame], images.grid, PIXEL)
    axes.imshow(
        picture, cmap="gray", origin="lower", extent=(left, right, bottom, top), vmin=0.0, vmax=float(bright)
    )
    places = {(1.0, 0.5): view.right, (0.0, 0.5): -view.right, (0.5, 1.0): view.up, (0.5, 0.0): -view.up}
    for (x, y), direction in places.items():
        axes.text(
            0.03 + 0.94 * x,
            0.03 + 0.94 * y,
            letters(direction),
            color="white",
            fontsize=9,
            fontweight="bold",
            ha="center",
            va="center",
            transform=axes.transAxes,
        )
    axes.set_axis_off()


def letters(direction: Floats) -> str:
    """The patient's sides that a direction (3,) leads to, the nearest first: "AL" is front and left."""
    near = [axis for axis in np.argsort(-np.abs(direction)) if abs(direction[axis]) > 0.4]
    return "".join(TOWARDS[axis][int(direction[axis] > 0.0)] for axis in near)
