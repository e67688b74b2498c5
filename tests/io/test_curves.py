"""Curves are read back as written; bad files are named with the place and advice."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.io.curves import read_curves, read_table_of_curves, write_curves
from heartfit.observation.curve import Curve

TIMES = np.arange(25) * 0.033


def sample() -> dict[str, Curve]:
    wave = np.cos(2 * np.pi * TIMES / 0.825)
    return {
        "lv_volume": Curve(TIMES, 120e-6 + 50e-6 * wave, 0.825),
        "lv_pressure": Curve(TIMES, 8e3 - 7e3 * wave, 0.825),
        "mitral_flow": Curve(TIMES, 1e-4 * wave, 0.825),
    }


def test_round_trip(tmp_path: Path) -> None:
    write_curves(tmp_path / "deep" / "measured.csv", sample())
    restored = read_curves(tmp_path / "deep" / "measured.csv")
    assert set(restored) == set(sample())
    for name, curve in sample().items():
        assert restored[name].values == pytest.approx(curve.values, rel=1e-10)
        assert restored[name].period == 0.825


def test_units_are_in_the_header(tmp_path: Path) -> None:
    write_curves(tmp_path / "c.csv", sample())
    lines = (tmp_path / "c.csv").read_text().splitlines()
    assert lines[0] == "# period_s = 0.825"
    assert lines[1] == "time_s,lv_volume_ml,lv_pressure_kpa,mitral_flow_ml_per_s"
    assert lines[2] == "0,170,1,100"


def test_curves_keep_their_own_times_in_one_file(tmp_path: Path) -> None:
    fast = np.arange(200) * 0.004
    curves = sample() | {"lv_pressure": Curve(fast, 8e3 - 7e3 * np.cos(2 * np.pi * fast / 0.825), 0.825)}
    write_curves(tmp_path / "c.csv", curves)
    restored = read_curves(tmp_path / "c.csv")
    for name, curve in curves.items():
        assert restored[name].times == pytest.approx(curve.times, abs=1e-12)
        assert restored[name].values == pytest.approx(curve.values, rel=1e-10)
    with pytest.raises(InputError, match="lv_volume in data row 2 is empty"):
        read_table_of_curves(tmp_path / "c.csv")


def test_curves_of_different_periods_do_not_share_a_file(tmp_path: Path) -> None:
    curves = sample() | {"rv_volume": replace(sample()["lv_volume"], period=0.9)}
    with pytest.raises(ValueError, match="rv_volume has its own period"):
        write_curves(tmp_path / "c.csv", curves)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("time_s", "time", "no column time_s"),
        ("lv_volume_ml", "lv_volum_ml", "unknown column lv_volum_ml; did you mean lv_volume_ml"),
        ("lv_volume_ml", "volume", "did you mean lv_volume_ml or rv_volume_ml. Rename"),
        ("lv_pressure_kpa", "lv_pressure", "did you mean lv_pressure_kpa or lv_pressure_mmhg"),
        ("# period_s = 0.825", "# beat", "no period.*--rr"),
        ("0,170,1,100", "0,nan,1,100", "lv_volume_ml in data row 1 is nan"),
        ("0,170,1,100", "0,many,1,100", "lv_volume_ml in data row 1 is many"),
        ("0,170,1,100", ",170,1,100", "time_s in data row 1 is empty"),
        ("0,170,1,100", "0.04,170,1,100", "expected increasing times"),
        ("lv_pressure_kpa", "lv_volume_ml", "c.csv: column lv_volume_ml occurs twice"),
        ("0,170,1,100", "0,170,120,100", "c.csv: pressure: values from .* to 120000 Pa.* mmHg taken for kPa"),
        ("0,170,1,100", "0,0.17,1,100", "c.csv: volume: values from 0.17 to"),
    ],
)
def test_bad_files_are_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    path = tmp_path / "c.csv"
    write_curves(path, sample())
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(InputError, match=message):
        read_curves(path)


def test_a_pressure_in_millimetres_of_mercury_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "c.csv"
    rows = "\n".join(f"{t},{80 + 40 * np.cos(2 * np.pi * t / 0.825)}" for t in TIMES)
    path.write_text(f"# period_s = 0.825\ntime_s,lv_pressure_kpa\n{rows}\n")
    with pytest.raises(InputError, match="probably mmHg taken for kPa"):
        read_curves(path)


@pytest.mark.parametrize("content", ["", "time_s\n0.1\n"])
def test_a_file_without_curves_is_refused(tmp_path: Path, content: str) -> None:
    path = tmp_path / "c.csv"
    path.write_text(content)
    with pytest.raises(InputError, match="expected"):
        read_curves(path)
    with pytest.raises(InputError, match="no such file"):
        read_curves(tmp_path / "absent.csv")
