"""Septal flash as table and figure: tables are read back as written; failed beats are excluded."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from heartfit.io.tables import read_shape, write_csv
from heartfit.observation.strain import WallMotion, septal_flash
from heartfit.results.septal_flash import flash_table, plot_walls, walls_by_case
from heartfit.results.shape import COLUMNS, walls_table

TIMES = 0.01 * np.arange(80)
WAVE = np.sin(np.pi * np.clip(TIMES / 0.4, 0.0, 1.0))
EJECTED = np.sin(np.pi * np.clip((TIMES - 0.06) / 0.4, 0.0, 1.0))
FLASH = np.interp(TIMES, [0.0, 0.05, 0.1, 0.3, 0.5, 0.8], [0.0, 4e-3, 3e-3, 5e-3, 0.0, 0.0])
NOTHING = pd.DataFrame(columns=["time (s)"])


def walls(septal: np.ndarray) -> WallMotion:
    return WallMotion(TIMES, septal, 5e-3 * WAVE, -0.2 * WAVE, -0.1 * WAVE, (150.0 - 70.0 * EJECTED) * 1e-6)


def shape(motion: WallMotion) -> pd.DataFrame:
    """The columns of a calibrated shape that its walls need."""
    rest = pd.DataFrame({"time (s)": motion.times, "LV volume (mL)": 1e6 * motion.cavity})
    return rest.join(walls_table(motion))


def test_a_calibrated_flash_is_that_of_the_file(tmp_path: Path) -> None:
    write_csv(tmp_path / "shape.csv", shape(walls(FLASH)))
    calibrated = [read_shape(tmp_path / "shape.csv")]
    (motions,) = walls_by_case(["lbbb1"], ["physical"], [walls(FLASH)], [walls(WAVE)], calibrated).values()
    assert list(motions) == ["true", "registered", "physical"]
    assert motions["physical"].lateral_strain == pytest.approx(motions["true"].lateral_strain, abs=1e-6)
    fitted, true = septal_flash(motions["physical"]), septal_flash(motions["true"])
    assert fitted is not None
    assert true is not None
    assert fitted.size == pytest.approx(true.size, rel=1e-4)
    assert "LV volume (mL)" in COLUMNS


def test_settings_go_with_their_case_and_a_failed_beat_is_left_out() -> None:
    shapes = [shape(walls(FLASH)), NOTHING, NOTHING, shape(walls(5e-3 * WAVE))]
    measured = [walls(FLASH), walls(5e-3 * WAVE)]
    cases = walls_by_case(["a", "b"], ["locking", "physical"], measured, measured, shapes)
    assert [list(motions)[2:] for motions in cases.values()] == [["locking"], ["physical"]]


def test_the_table_has_the_flash_in_mm_and_ms_or_is_empty() -> None:
    cases = walls_by_case(
        ["a", "b"], [], [walls(FLASH), walls(5e-3 * WAVE)], [walls(FLASH), walls(5e-3 * WAVE)], []
    )
    table = flash_table(cases)
    assert table.loc[0, ["septal flash (mm)", "from (ms)", "to (ms)"]].tolist() == pytest.approx(
        [4, 0, 50], abs=1e-9
    )
    assert table.loc[2, ["septal flash (mm)", "rebound (mm)"]].isna().all()
    assert table["case"].tolist() == ["a", "a", "b", "b"]


def test_the_figure_marks_the_septal_flash() -> None:
    cases = walls_by_case(
        ["a", "b"], ["physical"], [walls(FLASH), walls(5e-3 * WAVE)], [walls(FLASH)] * 2, [NOTHING] * 2
    )
    figure = plot_walls(cases, ["physical"])
    texts = [text.get_text() for axes in figure.axes[:2] for text in axes.texts]
    assert texts == ["septal flash 4.0 mm", "no septal flash"]
    assert len(figure.axes[0].patches) == 1
    assert len(figure.axes[1].patches) == 0


def test_a_setting_keeps_its_line_where_another_one_failed() -> None:
    """The key has both settings; the only calibrated line of the case has that of the second."""
    shapes = [NOTHING, shape(walls(FLASH))]
    settings = ["locking", "physical"]
    cases = walls_by_case(["a"], settings, [walls(FLASH)], [walls(FLASH)], shapes)
    figure = plot_walls(cases, settings)
    keys = dict(
        zip((text.get_text() for text in figure.legends[0].texts), figure.legends[0].get_lines(), strict=True)
    )
    calibrated = figure.axes[0].get_lines()[-3]
    assert calibrated.get_linestyle() == keys["calibrated, physical setting"].get_linestyle()
    assert calibrated.get_linestyle() != keys["calibrated, locking setting"].get_linestyle()
