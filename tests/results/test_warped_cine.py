"""Table and figure of warped images: signs and units of the errors, and true and registered outlines."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.io.figures import write_figure
from heartfit.observation.comparison import Comparison, compare_motions
from heartfit.observation.operator import VolumeFeatures
from heartfit.results.warped_cine import plot_warped, warped_table
from tests.results.imaged_beat import FRAMES, beating, images

FEATURES = VolumeFeatures(frames=FRAMES)


@pytest.fixture(scope="module")
def comparison(ventricle: VentricularMesh) -> Comparison:
    """Registration recovers nine tenths of the motion."""
    true = beating(ventricle)
    positions = ventricle.points + 0.9 * (true.positions - ventricle.points)
    registered = type(true)(true.times, true.period, positions)
    return compare_motions(ventricle, true, registered, {"lv_volume": FEATURES})


def test_errors_have_signs_and_units(comparison: Comparison) -> None:
    row, paper = warped_table({"every": comparison}).to_dict("records")
    assert row["images"] == "real cine, every frame warped"
    assert row["V_min (%)"] > 0.0
    assert row["q_max (%)"] < 0.0
    assert row["q_min (%)"] < 0.0
    true, recovered = comparison.pair.true.curves, comparison.pair.measured.curves
    difference = recovered["lv_volume"].values - true["lv_volume"].values
    assert row["LV RMS (mL)"] == pytest.approx(1e6 * np.sqrt(np.mean(difference**2)))
    assert row["ES points (mm)"] == pytest.approx(1e3 * comparison.point_error[comparison.end_systole, 0])
    assert paper["q_max (%)"] == "25, unsigned"


def test_the_figure_shows_both_outlines_in_every_slice(
    ventricle: VentricularMesh, comparison: Comparison, tmp_path: Path
) -> None:
    positions = beating(ventricle).positions
    sequence = images(ventricle)
    figure = plot_warped(
        {"every": sequence},
        ventricle,
        {"true": positions, "every": positions},
        {"every": comparison, "phantom": comparison},
        FEATURES,
    )
    panels = figure.subfigs[0].axes
    assert len(panels) == sequence.grid.size[2] - 2
    middle = panels[len(panels) // 2]
    assert len(middle.collections) == 6
    assert [len(part.get_segments()) > 0 for part in middle.collections].count(True) >= 4
    assert [line.get_label() for line in figure.subfigs[1].axes[0].lines] == [
        "simulated",
        "real cine, every frame warped",
        "phantom in the same slices",
    ]
    write_figure(tmp_path / "warped.png", figure)
