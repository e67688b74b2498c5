"""A recorded pressure without a unit is refused; mmHg and kPa give the same pressure."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.io.pressures import read_pressure
from heartfit.study.case import RecordedPressure

PERIOD = 0.8
TIMES = np.arange(0.0, PERIOD, 0.004)
PASCALS = 1e3 + 14e3 * np.exp(-(((TIMES - 0.2) / 0.09) ** 4))
MMHG = 133.322368


def table(tmp_path, header, *columns):
    path = tmp_path / "pressure.csv"
    np.savetxt(path, np.column_stack(columns), "%.6f", ",", header=header, comments="")
    return path


def read(path, **options):
    return read_pressure(RecordedPressure(file=str(path), **options), PERIOD).curve


@pytest.mark.parametrize(
    ("header", "time", "pressure", "options"),
    [
        ("time_s,lv_pressure_kpa", 1.0, 1e3, {}),
        ("time_ms,lv_pressure_mmhg", 1e-3, MMHG, {}),
        ("Time [s],LV pressure (mmHg)", 1.0, MMHG, {}),
        ("time_s,PLV", 1.0, MMHG, {"unit": "mmHg"}),
        ("time_s,PLV", 1.0, 1e3, {"unit": "kPa", "column": "PLV"}),
    ],
)
def test_every_unit_gives_the_same_pressure(tmp_path, header, time, pressure, options):
    curve = read(table(tmp_path, header, TIMES / time, PASCALS / pressure), **options)
    assert curve.values == pytest.approx(PASCALS, abs=0.5)
    assert curve.times == pytest.approx(TIMES, abs=1e-9)


def test_the_zero_of_the_line_is_taken_off_in_its_own_unit(tmp_path):
    path = table(tmp_path, "time_s,lv_pressure_mmhg", TIMES, PASCALS / MMHG + 5.0)
    assert read(path, zero=5.0).values == pytest.approx(PASCALS, abs=0.5)


def test_the_left_ventricle_is_identified_by_its_name_or_by_the_user(tmp_path):
    columns = TIMES, PASCALS / 1e3, 0.2 * PASCALS / 1e3
    named = table(tmp_path, "time_s,lv_pressure_kpa,rv_pressure_kpa", *columns)
    assert read(named).values.max() == pytest.approx(PASCALS.max(), rel=1e-3)
    unnamed = table(tmp_path, "time_s,p1_kpa,p2_kpa", *columns)
    with pytest.raises(
        InputError,
        match=r"pressure\.csv: the column of the left-ventricular pressure .* p1_kpa, p2_kpa: state it",
    ):
        read(unnamed)
    assert read(unnamed, column="p1_kpa").values.max() == pytest.approx(PASCALS.max(), rel=1e-3)


@pytest.mark.parametrize(
    ("header", "options", "message"),
    [
        ("time_s,lv_pressure", {}, "column lv_pressure has no unit; expected lv_pressure_mmhg or"),
        ("time_s,lv_pressure_kpa", {"unit": "mmHg"}, "and the stated unit mmHg disagree"),
        ("time,lv_pressure_kpa", {}, "0 columns of times with a unit"),
        ("time_s,lv_pressure_kpa", {"trigger": "ecg"}, "no column ecg, stated as the trigger"),
        ("time_s,lv_pressure_kpa", {"column": "aorta"}, "no column aorta"),
        ("time_ms,lv_pressure_kpa", {}, "is the unit of time right|the beats are"),
    ],
)
def test_missing_statements_are_refused(tmp_path, header, options, message):
    path = table(tmp_path, header, TIMES, PASCALS / 1e3)
    with pytest.raises(InputError, match=message) as refused:
        read(path, **options)
    assert str(refused.value).startswith(str(path))
    assert "\n" not in str(refused.value)


def test_a_cell_that_is_no_number_is_named(tmp_path):
    path = table(tmp_path, "time_s,lv_pressure_kpa", TIMES, PASCALS / 1e3)
    path.write_text(path.read_text().replace("\n0.004000,", "\n0.004000,x", 1))
    with pytest.raises(InputError, match="lv_pressure_kpa in data row 2 is x1"):
        read(path)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"unit": "Pa"}, "'mmHg' or 'kPa'"),
        ({"trigger": "ecg", "upstroke": 0.1}, "trigger and upstroke both say"),
        ({"upstroke": 0.1, "delay": 0.01}, "leave delay out"),
    ],
)
def test_contradictions_are_refused(content, message):
    with pytest.raises(InputError, match=message):
        validate(RecordedPressure, {"file": "x.csv", **content}, "config.yaml")
