"""The registrations that are compared, by family and name."""

from collections.abc import Callable
from functools import partial
from typing import Any

from benchmarks.registration.carried import Matching, carried, nothing
from benchmarks.registration.library import affine_first, demons, splines
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.imaging.sequence import ImageSequence

Method = Callable[[ImageSequence, VentricularMesh], Motion]

HALF, TWO, FULL = ((2, 40),), ((4, 40), (2, 40)), ((2, 40), (1, 30))
EVERYWHERE = 0.03
"""A reach, m, that holds the whole image."""

OURS = "default settings"


def ours(**settings: Any) -> Method:
    """The free-form deformation of the package, with some of its settings changed."""
    return lambda sequence, mesh: track(sequence, mesh, FreeForm(**settings)).motion


def theirs(matching: Matching, blank: bool = False) -> Method:
    """A matching of SimpleITK's."""
    return partial(carried, matching=matching, blank=blank)


def _fast(
    smoothing: float = 1.0, levels: tuple[tuple[int, int], ...] = HALF, update: float = 0.0
) -> Matching:
    return demons("fast symmetric", levels, smoothing, update)


def _diffeomorphic(smoothing: float, levels: tuple[tuple[int, int], ...] = TWO) -> Matching:
    return demons("diffeomorphic", levels, smoothing)


METHODS: dict[str, dict[str, Method]] = {
    "no registration": {"mesh of end diastole": theirs(nothing)},
    "SimpleITK demons, diffeomorphic": {
        "smoothing 1, half resolution": theirs(_diffeomorphic(1.0, HALF)),
        "smoothing 1.5, quarter and half": theirs(_diffeomorphic(1.5)),
        "smoothing 1.5, quarter and half, uniform background": theirs(_diffeomorphic(1.5), blank=True),
        "smoothing 3, quarter and half": theirs(_diffeomorphic(3.0)),
    },
    "SimpleITK demons, fast symmetric": {
        "smoothing 1, half resolution": theirs(_fast()),
        "smoothing 1, half resolution, uniform background": theirs(_fast(), blank=True),
        "smoothing 1, half and full": theirs(_fast(levels=FULL)),
        "smoothing 2, half resolution": theirs(_fast(2.0)),
        "smoothing 0.5, update smoothing 1, half resolution": theirs(_fast(0.5, update=1.0)),
    },
    "SimpleITK affine": {
        "near the wall, affine map only": theirs(affine_first(nothing)),
        "followed by fast symmetric demons, smoothing 1": theirs(affine_first(_fast())),
        "followed by diffeomorphic demons, smoothing 1": theirs(affine_first(_diffeomorphic(1.0, HALF))),
    },
    "SimpleITK B-splines, half resolution": {
        "15 mm, near the wall, 20 steps": theirs(splines(7.5, 20, 0.2)),
        "15 mm, near the wall, 60 steps": theirs(splines(7.5, 60, 0.2)),
        "10 mm, near the wall, 20 steps": theirs(splines(5.0, 20, 0.2)),
        "15 mm, whole image, 20 steps": theirs(splines(7.5, 20, 0.05, near=False)),
    },
    "heartfit": {
        OURS: ours(),
        "without the wall volume term": ours(incompressibility=0.0),
        "whole image compared": ours(reach=EVERYWHERE),
        "without the wall volume term, whole image compared": ours(incompressibility=0.0, reach=EVERYWHERE),
        "half resolution only": ours(levels=((2, 13),)),
        "control points 8 mm apart": ours(knots=8e-3),
        "control points 15 mm apart": ours(knots=15e-3),
    },
}
