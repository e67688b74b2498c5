"""Recordings from files, each curve at its own times, and one line for what cannot be one."""

import numpy as np
import pytest

from heartfit.errors import InputError
from heartfit.io.recordings import read_recording


def written(path, text):
    path.write_text(text)
    return path


def table(header, rows):
    return f"{header}\n" + "\n".join(",".join(map(str, row)) for row in rows) + "\n"


def test_empty_cells_are_other_times_and_beats_may_follow(tmp_path):
    times = np.arange(40) * 0.05
    rows = [(t, 100 + k % 2, 10 if k % 2 else "") for k, t in enumerate(times)]
    path = written(tmp_path / "m.csv", table("time_s,lv_volume_ml,aortic_pressure_kpa", rows))
    recording = read_recording(path, 0.9)
    assert recording.searched == ("lv_volume", "aorta_pressure")
    assert recording.curves["lv_volume"].times == pytest.approx(times)
    assert recording.curves["aorta_pressure"].times == pytest.approx(times[1::2])
    assert recording.curves["aorta_pressure"].values == pytest.approx(1e4)


@pytest.mark.parametrize(
    ("header", "rows", "period", "expected"),
    [
        ("time_s,lv_volume_ml", [(k * 0.05, 100) for k in range(20)], None, "no period"),
        ("time_s,lv_volume_ml", [(k * 0.05, 0.1) for k in range(20)], 0.9, "probably L taken for mL"),
        ("time_s,lv_volume_ml", [(0.05 * (k % 10), 100) for k in range(20)], 0.9, "lv_volume: time goes"),
        ("time_s,lv_volume_ml", [(k * 0.05, "nan") for k in range(20)], 0.9, "data row 1 is nan"),
        ("time_s,lv_volume_ml", [(k * 0.05, 100) for k in range(5)], 0.9, "at least 8"),
        ("time_s,lv_pressure_kpa", [(k * 0.05, 10) for k in range(20)], 0.9, "no lv_volume"),
        ("time_s,lv_volume", [(k * 0.05, 10) for k in range(20)], 0.9, "did you mean lv_volume_ml"),
        ("lv_volume_ml", [(100,)], 0.9, "no column time_s"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(tmp_path, header, rows, period, expected):
    path = written(tmp_path / "m.csv", table(header, rows))
    with pytest.raises(InputError, match=expected) as problem:
        read_recording(path, period)
    assert str(problem.value).startswith(str(path))
    assert "\n" not in str(problem.value)
