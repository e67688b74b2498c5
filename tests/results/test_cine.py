"""Tables and figures of the measured cine, on discs of known motion."""

import numpy as np
import pandas as pd
import pytest

from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.observation.cine import CineComparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.outlines import Outline, WallPoints
from heartfit.results.cine import (
    outline_table,
    plot_outlines,
    plot_volumes,
    short_axis_volume_table,
    wall_table,
)

FRAMES, ES = 8, 3
NORMAL = np.array([0.0, 0.0, 1.0])
ANGLE = np.linspace(0.0, 2.0 * np.pi, 361)
UNIT = np.column_stack([np.cos(ANGLE), np.sin(ANGLE), np.zeros(361)])
TRUE = np.array([20.0, 18.0, 15.0, 12.0, 14.0, 16.0, 18.0, 19.0]) * 1e-3
REGISTERED = TRUE + np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0]) * 1e-3
"""Radii [m]: exact, except for 1 mm too much at end systole and 1 mm too little in the last frame."""


def circle(radius: float) -> np.ndarray:
    return radius * np.stack([UNIT[:-1], UNIT[1:]], axis=1)


def outline(surface: str, whole: np.ndarray) -> Outline:
    return Outline(surface, 1, NORMAL, np.array([*map(circle, REGISTERED)]), tuple(map(circle, TRUE)), whole)


@pytest.fixture
def cine() -> CineComparison:
    inside = np.arange(FRAMES) < 2
    steps = np.outer(np.arange(FRAMES), [1e-3, 2e-3, 5e-3])[:, None]
    at_rest = np.zeros((FRAMES, 4, 3))
    wall = WallPoints(1, NORMAL, at_rest, at_rest + steps, np.tile([1.0, 0.0, 0.0], (4, 1)))
    values = {"surface": TRUE * 5e-3, "cut": TRUE * 5e-3 + 2e-6, "registered": REGISTERED * 5e-3}
    volumes = {name: Curve.of_volume(0.1 * np.arange(FRAMES), volume, 0.8) for name, volume in values.items()}
    outlines = [outline("lv_endo", np.ones(FRAMES, bool)), outline("rv_endo", inside)]
    return CineComparison(outlines, [wall], volumes, ES)


def test_errors_of_outlines_are_in_per_cent_of_the_first_area_and_in_mm(cine: CineComparison) -> None:
    left, right = outline_table(cine).to_dict("records")
    error = 100.0 * (REGISTERED**2 - TRUE**2) / TRUE[0] ** 2
    assert left["ED (cm^2)"] == pytest.approx(np.pi * 4.0, rel=1e-3)
    assert left["error ES (% of ED)"] == pytest.approx(error[ES], rel=1e-3)
    assert left["error RMS (% of ED)"] == pytest.approx(np.sqrt((error[1:] ** 2).mean()), rel=1e-3)
    assert left["distance ES (mm)"] == pytest.approx(1.0, rel=1e-3)
    assert left["distance (mm)"] == pytest.approx(2.0 / 7.0, rel=1e-3)
    assert left["unmoved (mm)"] == pytest.approx(1e3 * (TRUE[0] - TRUE[1:]).mean(), rel=1e-3)
    assert (left["frames"], right["frames"]) == (7, 1)
    assert np.isnan(right["error ES (% of ED)"])
    assert right["error RMS (% of ED)"] == pytest.approx(0.0)


def test_point_errors_of_the_wall_are_split_into_in_plane_and_through_plane(cine: CineComparison) -> None:
    (row,) = wall_table(cine).to_dict("records")
    assert row["ES (mm)"] == row["motion in plane ES (mm)"] == pytest.approx(ES * 5.0**0.5)
    assert row["beat (mm)"] == pytest.approx(4.0 * 5.0**0.5)
    assert row["outwards ES (mm)"] == pytest.approx(-ES)
    assert row["motion through plane ES (mm)"] == pytest.approx(5.0 * ES)


def test_volumes_are_compared_with_the_surface(cine: CineComparison) -> None:
    table = short_axis_volume_table(cine.volumes).set_index("volume")
    sizes = ["EDV (mL)", "ESV (mL)", "EF (%)", "RMS (mL)"]
    assert table.loc["surface", sizes].tolist() == pytest.approx([100.0, 60.0, 40.0, 0.0])
    assert table.loc["cut", sizes].tolist() == pytest.approx([102.0, 62.0, 100.0 * 40.0 / 102.0, 2.0])
    rates = VolumeFeatures()(cine.volumes["surface"])
    assert table.loc["cut", "q_max (mL/s)"] == pytest.approx(1e6 * rates["q_max"])
    assert table.loc["cut", "q_min (mL/s)"] == pytest.approx(1e6 * rates["q_min"])
    assert table.loc["registered", "RMS (mL)"] == pytest.approx(5.0 / 2.0)


def test_the_figures_draw_the_comparison(cine: CineComparison) -> None:
    grid = Grid((40, 40, 3), np.full(3, 2e-3), np.array([-0.04, -0.04, -2e-3]), np.eye(3))
    voxels = np.random.default_rng(1).uniform(0.0, 100.0, (FRAMES, 3, 40, 40))
    images = ImageSequence(grid, voxels, 0.1 * np.arange(FRAMES), 0.8)
    figure = plot_outlines(images, cine, "patient")
    systole, areas = figure.axes[1], figure.axes[3]
    assert systole.get_title() == "end systole, 300 ms"
    drawn = [np.array(lines.get_segments()) for lines in systole.collections[:2]]
    radii = [np.ptp(segments[..., 0]) for segments in drawn]
    assert radii == pytest.approx(
        [1e3 * TRUE[ES], 1e3 * REGISTERED[ES]]
    )  # a pixel is 2 mm: the diameter in pixels
    assert np.array_equal(systole.images[0].get_array(), voxels[ES, 1])
    assert areas.get_lines()[0].get_ydata() == pytest.approx(1e4 * np.pi * REGISTERED**2, rel=1e-3)
    assert pd.isna(areas.get_lines()[3].get_ydata()[2:]).all()
    curves = plot_volumes(cine.volumes, "patient").axes[0].get_lines()
    assert [line.get_ydata()[ES] for line in curves] == pytest.approx([60.0, 62.0, 65.0])
