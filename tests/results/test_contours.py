"""The pictures show the mesh of the phase over the image of the frame, and are the same bytes again."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from PIL import Image

from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.io.figures import write_animation
from heartfit.results.contours import animate_contours, plot_contours
from heartfit.results.overlay import Overlay
from tests.results.imaged_beat import FRAMES, PERIOD, SYSTOLE, beating, images

MEGABYTES = 1e6


def test_end_diastole_and_end_systole_are_drawn_with_their_outlines(ventricle: VentricularMesh) -> None:
    motion = beating(ventricle)
    figure = plot_contours(images(ventricle), ventricle, motion, "a heart")
    titles = [axes.get_title() for axes in figure.axes]
    assert titles[0] == "end diastole, 0 ms: slice"
    assert titles[3] == "end systole, 300 ms: slice"
    overlay = Overlay(images(ventricle), ventricle, motion)
    for axes, (view, phase) in zip(
        figure.axes, [(view, phase) for phase in (0, SYSTOLE) for view in overlay.views.values()], strict=True
    ):
        drawn = [part for part in axes.collections if isinstance(part, LineCollection)]
        for line, name in zip(drawn, ("lv_endo", "rv_endo", "epi"), strict=True):
            expected = 1e3 * view.outline(motion.positions[phase], ventricle.surfaces[name])
            assert np.reshape(line.get_segments(), expected.shape) == pytest.approx(expected)


def test_volumes_are_those_of_the_cavities(ventricle: VentricularMesh) -> None:
    overlay = Overlay(images(ventricle), ventricle, beating(ventricle))
    smallest = Cavity.from_endocardium(ventricle, "lv_endo").volume(ventricle.points) * 0.8**3
    assert overlay.volumes["lv"].min() == pytest.approx(smallest)


def test_an_animation_is_small_and_reproducible(ventricle: VentricularMesh, tmp_path: Path) -> None:
    """Noise compresses worst: real images are smaller."""
    sequence, motion = images(ventricle), beating(ventricle)
    for name in ("a.gif", "b.gif"):
        write_animation(tmp_path / name, animate_contours(sequence, ventricle, motion, "a heart"))
    content = (tmp_path / "a.gif").read_bytes()
    assert content == (tmp_path / "b.gif").read_bytes()
    assert len(content) * 30 / FRAMES < 3 * MEGABYTES
    with Image.open(tmp_path / "a.gif") as shown:
        assert shown.n_frames == FRAMES  # type: ignore[attr-defined]
        assert shown.info["duration"] == 100


def test_unknown_suffixes_and_mismatched_times_are_refused(
    ventricle: VentricularMesh, tmp_path: Path
) -> None:
    sequence, motion = images(ventricle), beating(ventricle)
    animation = animate_contours(sequence, ventricle, motion, "a heart")
    with pytest.raises(ValueError, match=r"\.gif, \.png"):
        write_animation(tmp_path / "a.mp4", animation)
    write_animation(tmp_path / "a.png", animation)
    late = Motion(motion.times + 0.01, PERIOD, motion.positions)
    with pytest.raises(InputError, match="times"):
        plot_contours(sequence, ventricle, late, "a heart")
