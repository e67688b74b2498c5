"""Races and coverages, printed and drawn with the numbers they hold."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.io.figures import write_figure
from heartfit.results.race import plot_race, plot_sphere_coverage, race_table, sphere_coverage_table
from heartfit.synthetic.race import Coverage, MethodScore

MARKS = [
    *(MethodScore(heart, "prior", 0, 10.0, 1.0) for heart in range(5)),
    *(MethodScore(heart, "unscented, R = 0", 9, float(heart), 0.1 * heart) for heart in range(5)),
    MethodScore(5, "unscented, R = 0", 9, np.nan, 9.0),
    MethodScore(0, "CMA-ES", 8, 3.0, 0.4),
]
COVERAGES = [
    Coverage(world, way, ("sigma_0", "R_p"), np.array([[0.0, 3.0], [1.0, -1.0], [np.nan, np.nan]]))
    for world in ("nothing", "parameters")
    for way in ("R = 0", "R and R_fixed")
]


def test_a_row_has_median_and_quartiles_of_the_hearts_that_beat() -> None:
    table = race_table({"volume": MARKS})
    row = table[table["method"] == "unscented, R = 0"].iloc[0]
    assert row["hearts"] == 5
    assert row["observations (%)"] == 2.0
    assert (row["observations, lower"], row["observations, upper"]) == (1.0, 3.0)
    assert row["parameters (prior sd)"] == pytest.approx(0.2)
    assert table["method"].tolist() == ["prior", "unscented, R = 0", "CMA-ES"]


def test_coverage_is_in_percent_with_its_interval_and_its_failures() -> None:
    table = sphere_coverage_table({"volume": COVERAGES})
    row = table[table["parameter"] == "sigma_0"].iloc[0]
    assert row["covered (%)"] == pytest.approx(200.0 / 3.0)
    assert row["low (%)"] < row["covered (%)"] < row["high (%)"]
    assert (row["hearts"], row["failed"]) == (3, 1)
    assert table[table["parameter"] == "all"]["covered (%)"].iloc[0] == pytest.approx(50.0)


def test_both_figures_are_drawn(tmp_path: Path) -> None:
    race = plot_race(race_table({"volume": MARKS, "volume and pressure": MARKS}))
    assert [len(axes.get_lines()) > 0 for axes in race.axes] == [True] * 4
    coverage = plot_sphere_coverage({"volume": COVERAGES})
    for name, figure in (("race", race), ("coverage", coverage)):
        write_figure(tmp_path / f"{name}.png", figure)
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
