"""Volume and pressure of one beat agree; shifted, stretched, exchanged and mislabelled curves are told from them."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.consistency import Loop, folded, implausible
from heartfit.discovery.sphere_model.recording import Recording, Samples, averaged_by_phase

PERIOD = 0.8
STROKE, LOW, HIGH = 80e-6, 1e3, 15e3


def flank(t: np.ndarray, begin: float, end: float) -> np.ndarray:
    """A rise from 0 to 1 between two times."""
    return np.clip((t - begin) / (end - begin), 0.0, 1.0)


def volume(t: np.ndarray) -> np.ndarray:
    """Ejection from 60 to 340 ms, filling from 420 to 740 ms."""
    return 140e-6 - STROKE * (flank(t, 0.06, 0.34) - flank(t, 0.42, 0.74))


def pressure(t: np.ndarray) -> np.ndarray:
    """A plateau with isovolumic flanks of 50 and 70 ms."""
    return LOW + (HIGH - LOW) * (flank(t, 0.01, 0.06) - flank(t, 0.345, 0.415))


def recording(lag: float = 0.0, stretch: float = 1.0, pascal: float = 1.0) -> Recording:
    frames, fine = np.arange(28) * PERIOD / 28, np.arange(800) * 1e-3
    late = np.mod(fine / stretch - lag, PERIOD)
    curves = {
        "lv_volume": Samples(frames, volume(frames)),
        "lv_pressure": Samples(fine, pascal * pressure(late)),
    }
    return Recording(PERIOD, curves)


def test_the_curves_of_one_beat_are_plausible() -> None:
    assert implausible(recording()) == ()


def test_the_work_is_the_area_of_the_loop() -> None:
    t = np.arange(1000) * PERIOD / 1000
    loop = Loop(volume(t), pressure(t), PERIOD)
    assert loop.work() == pytest.approx(STROKE * (HIGH - LOW), rel=1e-3), "a rectangle"
    turned = Loop(volume(t)[::-1], pressure(t)[::-1], PERIOD)
    assert turned.work() == pytest.approx(-loop.work())


@pytest.mark.parametrize("lag", [-0.14, 0.12, 0.16])
def test_a_lag_is_found_with_its_size(lag: float) -> None:
    lines = implausible(recording(lag))
    (warning,) = [line for line in lines if "late" in line]
    assert float(warning.split("seems ")[1].split(" ms")[0]) == pytest.approx(1e3 * lag, abs=40), warning


@pytest.mark.parametrize(("begin", "end", "phase"), [(0.42, 0.5, "falls"), (0.08, 0.12, "rises")])
def test_volume_that_moves_while_the_valves_are_closed_is_told(begin: float, end: float, phase: str) -> None:
    shape = recording().curves["lv_pressure"]
    fast, slow = flank(shape.times, begin, end), flank(shape.times, 0.6, 0.7)
    emptied = fast - slow if phase == "rises" else flank(shape.times, 0.06, 0.34) - fast
    for lag, expected in ((0.0, 0), (0.07, 1)):
        late = Samples(shape.times, pressure(np.mod(shape.times - lag, PERIOD)))
        swift = Samples(shape.times, 140e-6 - STROKE * emptied)
        lines = implausible(Recording(PERIOD, {"lv_volume": swift, "lv_pressure": late}))
        assert sum(f"while the pressure {phase}" in line for line in lines) == expected, lines


def test_a_lag_of_half_a_beat_turns_the_loop_and_is_refused() -> None:
    with pytest.raises(InputError, match=r"m\.csv: .*clockwise"):
        implausible(recording(0.4), "m.csv")


def test_a_pressure_of_another_rate_does_not_close() -> None:
    lines = implausible(recording(stretch=0.72))
    assert any("lv_pressure: the ends of the beat differ" in line or "late" in line for line in lines), lines
    rising = Samples(np.arange(780) * 1e-3, np.linspace(LOW, HIGH, 780))
    curves = {**recording().curves, "aorta_pressure": rising}
    (line,) = implausible(Recording(PERIOD, curves))
    assert line.startswith("aorta_pressure: the ends of the beat differ by 100 %")


def test_a_pressure_of_another_unit_is_told_by_its_peak() -> None:
    lines = implausible(recording(pascal=0.133))
    assert any(line.startswith("peak pressure 2") for line in lines), "kPa taken for mmHg"
    lines = implausible(recording(pascal=2.6))
    assert any(line.startswith("peak pressure 39") for line in lines)


def test_a_curve_alone_is_judged_by_its_ejection_fraction() -> None:
    whole = recording()
    alone = replace(whole, curves={"lv_volume": whole.curves["lv_volume"]})
    assert implausible(alone) == ()
    flat = Samples(
        whole.curves["lv_volume"].times, 140e-6 + 0.1 * (whole.curves["lv_volume"].values - 140e-6)
    )
    (line,) = implausible(replace(whole, curves={"lv_volume": flat}))
    assert line.startswith("ejection fraction 5.71 %")


def test_beats_are_averaged_by_phase() -> None:
    times = np.arange(3 * 40) * PERIOD / 40
    values = np.sin(2 * np.pi * times / PERIOD) + np.repeat([-1.0, 0.0, 1.0], 40)
    expected = np.sin(2 * np.pi * np.arange(40) / 40)
    assert folded(Samples(times, values), PERIOD, 40) == pytest.approx(expected, abs=1e-12)


def test_a_sample_that_rounding_puts_before_the_end_of_a_beat_begins_the_next() -> None:
    times = 0.1 * np.arange(12)
    times[3::3] -= 1e-13
    means = averaged_by_phase(Samples(times, np.arange(12.0)), 0.3, 0.1)
    assert means.values == pytest.approx([4.5, 5.5, 6.5])
    assert means.times == pytest.approx([0.0, 0.1, 0.2], abs=1e-12)
