"""Pressure of a virtual heart, recorded as in a catheterisation: it is recovered with its rates."""

import numpy as np
import pytest

from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.io.pressures import read_pressure
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import PressureFeatures
from heartfit.study.case import RecordedPressure
from heartfit.synthetic.scanner import Catheter

MMHG = 133.322368
STRETCHES = (1.0, 0.97, 1.02, 0.99, 0.7, 1.25, 1.01, 0.98)
"""Lengths of the beats relative to the period; the fifth is early and weak, followed by a pause."""
EARLY = 4


@pytest.fixture(scope="module")
def beat(spherical_heart: Heart) -> Beat:
    return simulate_spheres(spherical_heart, [Sphere.from_volumes(80e-6, 130e-6)], Numerics(time_step=2e-3))


@pytest.fixture(scope="module")
def rows(beat: Beat) -> np.ndarray:
    """Times in ms, pressures in mmHg with the line's zero 3 mmHg off, and an ECG, over eight beats."""
    times, pressures, ecg, start = [], [], [], 0.0
    for number, stretch in enumerate(STRETCHES):
        here, pressure, _ = Catheter(rate=500.0 / stretch, noise=60.0, offset=0.0).record(beat, number)
        times.append(start + here * stretch)
        pressures.append(pressure * (0.5 if number == EARLY else 1.0) / MMHG + 3.0)
        ecg.append(np.exp(-((here / 0.008) ** 2)))
        start += beat.period * stretch
    return np.column_stack([1e3 * np.concatenate(times), np.concatenate(pressures), np.concatenate(ecg)])


@pytest.mark.parametrize("way", [{"trigger": "ecg"}, {"upstroke": None}], ids=["with an ECG", "without one"])
def test_the_averaged_recording_is_the_simulated_pressure(tmp_path, beat, rows, way):
    true = beat_curves(beat)["lv_pressure"]
    if "upstroke" in way:
        rate = PressureFeatures().rate(true)
        way = {"upstroke": float(rate.times[rate.values.argmax()])}
    file = tmp_path / "pressure.csv"
    np.savetxt(file, rows, "%.4f", ",", header="time_ms,lv_pressure_mmhg,ecg", comments="")
    source = RecordedPressure(file=str(file), column="lv_pressure_mmhg", zero=3.0, **way)
    averaged = read_pressure(source, beat.period)
    assert averaged.kept.sum() >= 4
    assert averaged.kept.sum() <= len(averaged.kept) - 2, "the early beat and the pause after it"
    features = PressureFeatures()
    observed, expected = features(averaged.curve), features(true)
    for name, value in expected.items():
        assert observed[name] == pytest.approx(value, rel=0.03), name
