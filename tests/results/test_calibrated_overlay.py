"""Both motions are drawn over the images in separate colours; the title gives their distance."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.results.colours import SETTING_COLOURS
from heartfit.results.overlay import OUTLINES, REGISTERED, Overlay, plot_overlay
from tests.printed import numbers_in
from tests.results.imaged_beat import SYSTOLE, beating, images

CALIBRATED = SETTING_COLOURS[0]
GLIDE = np.array([0.0, 0.0, 2e-3])


def shifted(motion: Motion) -> Motion:
    """Half of the glide, all of it at end systole."""
    share = np.full(len(motion.times), 0.5)
    share[SYSTOLE] = 1.0
    return Motion(motion.times, motion.period, motion.positions + share[:, None, None] * GLIDE)


def test_each_motion_is_drawn_in_its_colour_and_phase(ventricle: VentricularMesh) -> None:
    motions = {REGISTERED: beating(ventricle), CALIBRATED: shifted(beating(ventricle))}
    figure = plot_overlay(images(ventricle), ventricle, *motions.values(), "a heart", CALIBRATED)
    views = Overlay(images(ventricle), ventricle, motions[REGISTERED]).views.values()
    panels = [(view, phase) for phase in (0, SYSTOLE) for view in views]
    for axes, (view, phase) in zip(figure.axes, panels, strict=True):
        drawn = [part for part in axes.collections if isinstance(part, LineCollection)]
        expected = [(colour, name) for colour in motions for name in OUTLINES]
        for line, (colour, name) in zip(drawn, expected, strict=True):
            segments = 1e3 * view.outline(motions[colour].positions[phase], ventricle.surfaces[name])
            assert to_hex(line.get_colors()[0]).upper() == colour
            assert np.reshape(line.get_segments(), segments.shape) == pytest.approx(segments)


def test_the_title_gives_the_distance_of_the_outlines(ventricle: VentricularMesh) -> None:
    motion = beating(ventricle)
    same = plot_overlay(images(ventricle), ventricle, motion, motion, "a heart", CALIBRATED)
    assert numbers_in(same.get_suptitle()) == [0.0, 0.0]
    other = plot_overlay(
        images(ventricle), ventricle, motion, shifted(motion), "a heart", CALIBRATED
    ).get_suptitle()
    mean, most = numbers_in(other)
    assert 0.3 < mean < 1.5 < most <= 2.0


def test_a_failed_beat_leaves_the_registered_outlines(ventricle: VentricularMesh) -> None:
    figure = plot_overlay(images(ventricle), ventricle, beating(ventricle), None, "a heart", CALIBRATED)
    assert figure.get_suptitle().startswith("a heart: ")
    assert numbers_in(figure.get_suptitle()) == []
    assert all(len(axes.collections) == len(OUTLINES) for axes in figure.axes)


def test_a_simulation_of_other_times_is_refused(ventricle: VentricularMesh) -> None:
    motion = beating(ventricle)
    late = Motion(motion.times + 0.01, motion.period, motion.positions)
    with pytest.raises(InputError, match=r"times"):
        plot_overlay(images(ventricle), ventricle, motion, late, "a heart", CALIBRATED)
