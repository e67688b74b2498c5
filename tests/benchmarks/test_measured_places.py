"""Table and figure of the places at which the residual of a measured heart acts."""

import numpy as np
import pytest

from benchmarks.measured_places import ResidualPlaces, plot_residual_places, residual_table
from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.places import REGIONS

TIMES = np.linspace(0.0, 0.8, 40)
FILLING = PlaceFunction("filling", "Pa", TIMES, 900.0 * np.sin(8.0 * TIMES), np.full(40, 200.0), np.zeros(40))
HEARTS = {
    "as it is": ResidualPlaces(112.4, {"filling": 39.7, "wall": 12.0}, FILLING),
    "extended": ResidualPlaces(25.2, {"filling": -2.3, "wall": 1.0}, FILLING),
}


def test_a_row_has_the_misfit_and_the_regions_that_were_tried() -> None:
    table = residual_table(HEARTS)
    assert table.columns.tolist() == ["heart", "misfit", "filling", "wall"]
    assert table.iloc[0].tolist() == ["as it is", "112", "39.7", "12.0"]


def test_the_figure_shows_evidence_over_zero_and_functions_in_kilopascal() -> None:
    bars, curves = plot_residual_places(HEARTS, threshold=10.0).axes
    widths = [bar.get_width() for bar in bars.patches]
    assert len(widths) == len(HEARTS) * len(REGIONS)
    assert (max(widths), min(widths)) == (39.7, 0.0)
    assert bars.lines[0].get_xdata() == pytest.approx([10.0, 10.0])
    assert curves.lines[0].get_ydata() == pytest.approx(0.9 * np.sin(8.0 * TIMES))
    assert {line.get_label() for line in curves.lines} >= set(HEARTS)
