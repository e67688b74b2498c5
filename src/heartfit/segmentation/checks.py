"""Can the labelled voxels be one heart that lies in its patient the right way round?"""

import numpy as np
from scipy.ndimage import label

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.segmentation.labels import Segmentation
from heartfit.segmentation.stack import Stack

TO_APEX, TO_RIGHT_VENTRICLE = np.array([0.45, -0.45, -0.77]), np.array([-0.85, -0.5, -0.2])
"""How a heart lies in the scanner's axes (left, posterior, superior); those of the measured heart, rounded."""

LARGEST_TURN = np.deg2rad(65.0)
"""Between a heart and one that lies as above, which is turned by 87 degrees and more if mirrored along any axes."""

AXES = (("right", "left"), ("front", "back"), ("feet", "head"))


def require_one_piece(stack: Stack) -> None:
    """Raises InputError, naming a voxel, if a part falls into pieces that do not touch, not even by a corner."""
    parts = {
        "lv_cavity": stack.parts["lv_cavity"],
        "rv_cavity": stack.parts["rv_cavity"],
        "heart": stack.heart,
    }
    for name, mask in parts.items():
        pieces, count = label(mask, structure=np.ones((3, 3, 3)))
        if count > 1:
            sizes = np.bincount(pieces.ravel())[1:]
            k, j, i = np.argwhere(pieces == 1 + sizes.argmin())[0].tolist()
            place = i, j, stack.number(k)
            raise InputError(
                f"segmentation: {name} has {count} pieces, the smallest of {sizes.min()} voxels at {place}; "
                "expected one: take stray voxels out or fill the gap"
            )


def require_upright(stack: Stack, segmentation: Segmentation) -> None:
    """Raises InputError if the heart lies as none does: mirrored, or in the coordinates of another format."""
    to_apex = -stack.step * segmentation.grid.direction[:, 2]
    to_right = _centre(segmentation, "rv_cavity") - _centre(segmentation, "lv_cavity")
    turn = _frame(TO_APEX, TO_RIGHT_VENTRICLE).T @ _frame(to_apex, to_right)
    if np.arccos(np.clip((np.trace(turn) - 1.0) / 2.0, -1.0, 1.0)) > LARGEST_TURN:
        raise InputError(
            f"segmentation: apex towards {_towards(to_apex)}, right ventricle towards {_towards(to_right)}; expected "
            f"about {_towards(TO_APEX)}, and {_towards(TO_RIGHT_VENTRICLE)}; mirrored, or left and right are swapped: "
            "correct its axes, or the labels"
        )


def _centre(segmentation: Segmentation, name: str) -> Floats:
    k, j, i = np.argwhere(segmentation.parts[name]).mean(axis=0)
    return segmentation.grid.points(np.array([i, j, k]))


def _frame(to_apex: Floats, to_right: Floats) -> Floats:
    """Columns: towards the apex, the right ventricle, and what is at right angles to both."""
    axis = to_apex / np.linalg.norm(to_apex)
    across = to_right - (to_right @ axis) * axis
    across = across / np.linalg.norm(across)
    return np.column_stack([axis, across, np.cross(axis, across)])


def _towards(direction: Floats) -> str:
    """The patient's directions in which a vector mostly points."""
    share = direction / np.abs(direction).max()
    order = np.argsort(-np.abs(share))
    return " and ".join(AXES[axis][int(share[axis] > 0.0)] for axis in order if abs(share[axis]) > 0.4)
