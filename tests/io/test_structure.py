"""Residuals of healthy hearts are read as they were written; a reference group needs some controls."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.landmarks import PHASES
from heartfit.io.structure import FEWEST_CONTROLS, read_controls, read_residuals, write_residuals

RESIDUALS = {
    ("here", 1): np.linspace(-0.1, 0.1, 2 * PHASES),
    ("there", 7): np.full(2 * PHASES, 0.02),
}
CURVES = "# period_s = 0.8\ntime_s,lv_volume_ml\n" + "".join(
    f"{0.04 * frame},{100 + 40 * np.cos(np.pi * frame / 10):.1f}\n" for frame in range(20)
)


def test_residuals_are_read_as_they_were_written(tmp_path: Path) -> None:
    write_residuals(tmp_path / "residuals.csv", RESIDUALS)
    assert read_residuals(tmp_path / "residuals.csv") == pytest.approx(
        np.array(list(RESIDUALS.values())), abs=5e-5
    )


def test_a_simulator_is_left_out(tmp_path: Path) -> None:
    write_residuals(tmp_path / "residuals.csv", RESIDUALS)
    kept = read_residuals(tmp_path / "residuals.csv", leave_out=["there"])
    assert kept.shape == (1, 2 * PHASES)
    assert kept[0, 0] == pytest.approx(-0.1)


def test_the_bank_holds_as_many_hearts_of_every_simulator() -> None:
    whole = read_residuals()
    without = {
        name: len(read_residuals(leave_out=[name]))
        for name in ("korakianitis", "naghavi", "physioblocks", "regazzoni", "svzerod", "ventricles")
    }
    assert len(whole) == 96
    assert set(without.values()) == {80}


def test_a_reference_group_is_read_by_file(tmp_path: Path) -> None:
    for control in range(FEWEST_CONTROLS):
        (tmp_path / f"control{control}.csv").write_text(CURVES)
    controls = read_controls(tmp_path)
    assert list(controls) == [f"control{control}.csv" for control in range(FEWEST_CONTROLS)]
    (tmp_path / "control0.csv").unlink()
    with pytest.raises(InputError, match="4 recordings; expected a folder with at least 5 CSV files"):
        read_controls(tmp_path)
