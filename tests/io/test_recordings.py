"""Recordings from files, each curve at its own times; invalid recordings are refused in one line."""

import numpy as np
import pytest

import heartfit as hf
from heartfit.core.errors import InputError
from heartfit.io.pressures import read_pressure
from heartfit.io.recordings import read_recording, write_recording
from heartfit.observation.curve import Curve
from heartfit.study.case import RecordedPressure


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
        (
            "lv_volume_ml",
            [(100,)],
            0.9,
            "no column time_s among lv_volume_ml; expected times in seconds or milliseconds",
        ),
        ("time_s;lv_volume_ml", [("0,05;100.5",)], 0.9, "time_s in data row 1 is 0,05"),
        ("time_s,lv_volume_ml", [(0.0, 100), (0.05, 100, 7)], 0.9, "3 cells, expected 2"),
        ("time_s,lv_volume_ml", [(50 * k, 100 + k) for k in range(20)], 0.9, "milliseconds"),
        ("time_s,lv_volume_ml", [(k * 0.05, 120) for k in range(20)], 0.9, "expected a curve that beats"),
        ("time_s,lv_volume_ml", [(k * 0.05, 20 - k) for k in range(40)], 0.9, "volume: values from -19 to"),
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


TIMES = np.arange(30) * 0.03
VOLUMES, PRESSURES = 100 + 20 * np.cos(7 * TIMES), 60 - 50 * np.cos(7 * TIMES)


def columns(separator, decimal, header, *values):
    rows = (
        "\t".join(f"{value:.5f}" for value in row).replace(".", decimal) for row in zip(*values, strict=True)
    )
    return separator.join(header) + "\n" + "\n".join(rows).replace("\t", separator) + "\n"


@pytest.mark.parametrize(
    ("separator", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")]
)
def test_separators_decimal_signs_and_units_of_others_are_read(tmp_path, separator, decimal):
    header = ("time_ms", "LV_Volume_ml", "lv_pressure_mmHg")
    text = columns(separator, decimal, header, 1e3 * TIMES, VOLUMES, PRESSURES)
    recording = read_recording(written(tmp_path / "m.csv", text), 0.9)
    volume, pressure = (recording.curves[name] for name in ("lv_volume", "lv_pressure"))
    assert volume.times == pytest.approx(TIMES, abs=1e-7)
    assert volume.values == pytest.approx(1e-6 * VOLUMES, abs=1e-11)
    assert pressure.values == pytest.approx(133.322368 * PRESSURES, abs=1e-2)


def test_whole_numbers_between_semicolons_stay_whole(tmp_path):
    text = columns(";", ".", ("time_ms", "lv_volume_ml"), 1e3 * TIMES, VOLUMES)
    text = "\n".join(line.replace(".00000", "") for line in text.splitlines())
    recording = read_recording(written(tmp_path / "m.csv", text), 0.9)
    assert recording.curves["lv_volume"].times[1] == pytest.approx(0.03)


def test_a_pressure_of_its_own_is_averaged_from_its_triggers(tmp_path):
    volumes = written(tmp_path / "v.csv", columns(",", ".", ("time_s", "lv_volume_ml"), TIMES, VOLUMES))
    fine = np.arange(3600) * 1e-3
    phase = np.mod(fine - 0.25, 0.9)
    signal = 60 - 50 * np.cos(2 * np.pi * phase / 0.9)
    marks = (phase < 0.02).astype(float)
    text = columns(";", ",", ("time_ms", "p_mmHg", "ecg"), 1e3 * fine, signal, marks)
    source = RecordedPressure(file=str(written(tmp_path / "p.csv", text)), trigger="ecg")
    averaged = read_pressure(source, 0.9).curve
    pressure = read_recording(volumes, 0.9).with_pressure(averaged).curves["lv_pressure"]
    expected = 133.322368 * (60 - 50 * np.cos(2 * np.pi * pressure.times / 0.9))
    assert pressure.values == pytest.approx(expected, abs=150.0), "a beat from its trigger, to a sample"
    assert np.ptp(pressure.times) < 0.9


def test_a_pressure_in_both_files_is_refused(tmp_path):
    text = columns(",", ".", ("time_s", "lv_volume_ml", "lv_pressure_mmhg"), TIMES, VOLUMES, PRESSURES)
    recording = read_recording(written(tmp_path / "m.csv", text), 0.9)
    with pytest.raises(InputError, match="expected it in one"):
        recording.with_pressure(Curve(TIMES[:29], 133.322368 * PRESSURES[:29], 0.9))


def test_a_beat_is_written_from_the_trigger_on(tmp_path):
    beat = hf.simulate(hf.adult())
    write_recording(tmp_path / "beat.csv", beat)
    recording, true = read_recording(str(tmp_path / "beat.csv")), hf.curves(beat)
    assert beat.trigger > 0.1
    assert recording.curves.keys() == {"lv_volume", "lv_pressure", "aorta_pressure"}
    for name, samples in recording.curves.items():
        assert 0.0 <= samples.times.min() < 0.006
        assert samples.times.max() < beat.period
        assert samples.values == pytest.approx(true[name](samples.times), rel=1e-9)


def test_a_recording_of_several_beats_is_written_as_it_is(tmp_path):
    volume = hf.Samples(np.arange(60) * 0.04, 1e-4 + 2e-5 * np.sin(np.arange(60)))
    pressure = hf.Samples(np.arange(90) * 0.02 + 0.005, 5e3 + 4e3 * np.sin(np.arange(90)))
    recording = hf.Recording(0.8, {"lv_volume": volume, "lv_pressure": pressure})
    write_recording(tmp_path / "beats.csv", recording)
    again = read_recording(tmp_path / "beats.csv")
    assert again.period == 0.8
    for name, samples in recording.curves.items():
        assert again.curves[name].times == pytest.approx(samples.times)
        assert again.curves[name].values == pytest.approx(samples.values)


def test_a_failed_beat_is_not_written(tmp_path):
    with pytest.raises(InputError, match="recording: the beat failed"):
        write_recording(tmp_path / "beat.csv", hf.simulate(hf.adult().with_parameters({"sigma_0": 1e9})))
    assert not list(tmp_path.iterdir())


def test_samples_may_be_lists():
    samples = hf.Samples([0.0, 0.1, 0.2], [1, 2, 3])
    assert samples.values.dtype == float
    with pytest.raises(InputError, match="expected one value a time"):
        hf.Samples([0.0, 0.1], [1.0])
