"""The shape of a motion as table and figure: units, end systole, and beats that failed."""

from dataclasses import fields
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import failed_beat
from heartfit.io.tables import read_shape, write_csv
from heartfit.observation.shape import Shape
from heartfit.results.case_figures import plot_shape
from heartfit.results.colours import SETTING_COLOURS
from heartfit.results.shape import (
    COLUMNS,
    VOLUME_COLUMNS,
    beat_shape_table,
    end_systole_table,
    shape_table,
)

WAVE = np.sin(np.linspace(0.0, np.pi, 9))
SHAPE = Shape(
    times=0.1 * np.arange(9),
    cavity=(120.0 - 60.0 * WAVE) * 1e-6,
    shortening=0.16 * WAVE,
    descent=0.011 * WAVE,
    rise=0.005 * WAVE,
    inward=0.004 * WAVE,
    thickening=0.5 * WAVE,
    twist=np.deg2rad(12.0) * WAVE,
    volume=1.0 + np.outer(WAVE, [-0.4, 0.0, 0.5]),
)


def test_every_curve_is_printed_once_and_in_its_unit() -> None:
    table = shape_table(SHAPE)
    assert {name for name, _ in COLUMNS.values()} | {"times", "volume"} == {f.name for f in fields(Shape)}
    middle = table.loc[4, list(COLUMNS)].tolist()
    assert middle == pytest.approx([16.0, 11.0, 5.0, 4.0, 50.0, 12.0, 60.0])
    assert table.loc[4, list(VOLUME_COLUMNS)].tolist() == pytest.approx([0.6, 1.0, 1.5])


def test_end_systole_is_where_the_ventricle_is_smallest(ventricle: VentricularMesh) -> None:
    nothing = beat_shape_table(ventricle, failed_beat("no equilibrium", 0.8, 0.1, {}))
    table = end_systole_table({"measured": shape_table(SHAPE), "calibrated": nothing})
    row = table.set_index("at end systole").loc["twist (degrees)"]
    assert row["measured"] == pytest.approx(12.0)
    assert row["healthy adults"] == "12.6 ± 1.5"
    assert pd.isna(row["calibrated"])
    assert table["measured"].iloc[0] == pytest.approx(0.4)


def test_the_written_table_is_drawn(tmp_path: Path) -> None:
    write_csv(tmp_path / "shape.csv", shape_table(SHAPE))
    shapes = {"measured": shape_table(SHAPE), "calibrated": read_shape(tmp_path / "shape.csv")}
    figure = plot_shape(shapes, "patient", SETTING_COLOURS[0])
    assert [axes.get_title() for axes in figure.axes[:7]] == list(COLUMNS)
    first, second = (line.get_ydata() for line in figure.axes[0].get_lines())
    assert second == pytest.approx(first, rel=1e-5)
    assert len(figure.axes[7].get_lines()) == 4
    with pytest.raises(InputError, match="simulate it first"):
        read_shape(tmp_path / "nothing.csv")
