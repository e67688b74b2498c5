"""Recordings from files, each curve at its own times; invalid recordings are refused in one line."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.io.beats import read_recording


def written(path, text):
    path.write_text(text)
    return path


def table(header, rows):
    return f"{header}\n" + "\n".join(",".join(map(str, row)) for row in rows) + "\n"


def test_empty_cells_are_other_times_and_beats_may_follow(tmp_path):
    times = np.arange(40) * 0.05
    rows = [(t, 100 + 20 * (k % 2), k % 4 if k % 2 else "") for k, t in enumerate(times)]
    path = written(tmp_path / "m.csv", table("time_s,lv_volume_ml,aortic_pressure_kpa", rows))
    recording = read_recording(path, 0.9)
    assert recording.searched == ("lv_volume", "aorta_pressure")
    assert recording.curves["lv_volume"].times == pytest.approx(times)
    assert recording.curves["aorta_pressure"].times == pytest.approx(times[1::2])
    assert recording.curves["aorta_pressure"].values == pytest.approx(np.tile([1e3, 3e3], 10))


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
        ("time_s;lv_volume_ml", [("0,05;100",)], 0.9, "no commas between columns"),
        ("time_s,lv_volume_ml", [(0.0, 100), (0.05, 100, 7)], 0.9, "3 cells, expected 2"),
        ("time_s,lv_volume_ml", [(50 * k, 100 + k) for k in range(20)], 0.9, "milliseconds"),
        ("time_s,lv_volume_ml", [(k * 0.05, 120) for k in range(20)], 0.9, "expected a curve that beats"),
        ("time_s,lv_volume_ml", [(k * 0.05, 20 - k) for k in range(40)], 0.9, "volume: values from -1.9e-05"),
        ("time_s,lv_volume_ml", [(k * 0.05, 100) for k in range(3)], 0.9, "3 samples"),
    ],
)
def test_mistakes_are_reported_in_one_line(tmp_path, header, rows, period, expected):
    path = written(tmp_path / "m.csv", table(header, rows))
    with pytest.raises(InputError, match=expected) as problem:
        read_recording(path, period)
    assert str(problem.value).startswith(str(path))
    assert "\n" not in str(problem.value)


def test_a_byte_order_mark_and_letters_in_comments_are_accepted(tmp_path):
    rows = [(k * 0.03, 100 + k) for k in range(30)]
    text = "# period_s = 0.9\n# gemäß Gerät\n" + table("time_s,lv_volume_ml", rows)
    path = tmp_path / "m.csv"
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert read_recording(path).period == 0.9
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError, match="not UTF-8"):
        read_recording(path)
