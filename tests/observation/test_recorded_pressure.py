"""Mean beat of a recording: cut at its start, without outlying beats."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.observation.recorded_pressure import PressureTrace, average_beats

PERIOD, RATE, UPSTROKE = 0.83, 500.0, 0.092
ECTOPIC, PAUSE = 3, 4
LENGTHS = np.array([0.83, 0.82, 0.84, 0.60, 1.05, 0.83, 0.82, 0.83])
BEGIN = 0.21


def wave(share):
    """Pressure, Pa, by the share of the beat: it rises fastest where share * PERIOD = UPSTROKE, nearly."""
    return 1e3 + 15e3 * np.exp(-(((share - 0.22) / 0.11) ** 4))


def trace(lengths=LENGTHS, noise=0.0, rate=RATE, with_ecg=True):
    starts = BEGIN + np.append(0.0, np.cumsum(lengths))
    times = np.arange(0.0, starts[-1] + 0.3, 1.0 / rate)
    beat = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(lengths) - 1)
    pressures = wave(np.mod((times - starts[beat]) / lengths[beat], 1.0))
    if len(lengths) == len(LENGTHS):
        pressures[beat == ECTOPIC] *= 0.4
    random = np.random.default_rng(0)
    pressures += noise * random.standard_normal(times.size)
    ecg = np.exp(-(((times[:, None] - starts) / 0.01) ** 2)).sum(axis=1)
    return PressureTrace(
        times, pressures, ecg + 0.02 * random.standard_normal(times.size) if with_ecg else None
    )


def error(averaged):
    """RMS distance, Pa, from the truth."""
    return np.sqrt(np.mean((averaged.curve.values - wave(averaged.curve.times / PERIOD)) ** 2))


def test_the_ecg_cuts_the_recording_and_an_ectopic_beat_and_its_pause_are_left_out():
    averaged = average_beats(trace(noise=100.0), PERIOD)
    assert averaged.curve.period == PERIOD
    assert len(averaged.beats) == len(LENGTHS)
    assert np.flatnonzero(~averaged.kept).tolist() == [ECTOPIC, PAUSE]
    assert error(averaged) < 0.02 * 15e3, "the R wave is found to a sample or two"


def test_averaging_lowers_the_noise():
    alone, many = (
        average_beats(trace(np.full(count, PERIOD), noise=300.0, with_ecg=False), PERIOD, UPSTROKE)
        for count in (2, 20)
    )
    noise = [
        np.std(np.diff(averaged.curve.values - wave(averaged.curve.times / PERIOD)))
        for averaged in (alone, many)
    ]
    assert noise[1] < 0.5 * noise[0]


def test_without_an_ecg_a_beat_begins_at_the_steepest_rise():
    steepest = np.linspace(0.0, 0.3, 3001)[np.gradient(wave(np.linspace(0.0, 0.3, 3001) / PERIOD)).argmax()]
    averaged = average_beats(trace(np.full(6, PERIOD), with_ecg=False), PERIOD, float(steepest))
    assert error(averaged) < 0.02 * 15e3


def test_a_single_beat_begins_at_its_trigger():
    times = np.arange(0.0, PERIOD, 0.002)
    averaged = average_beats(PressureTrace(times, wave(times / PERIOD)), PERIOD)
    assert error(averaged) < 5.0
    late = average_beats(
        PressureTrace(times, wave(np.mod(times - 0.02, PERIOD) / PERIOD)), PERIOD, delay=0.02
    )
    assert error(late) < 5.0


def test_a_low_rate_keeps_its_samples_and_a_high_one_is_thinned():
    slow, fast = (
        average_beats(trace(np.full(4, PERIOD), rate=rate), PERIOD).curve for rate in (100.0, 4000.0)
    )
    assert slow.times.size == round(PERIOD * 100)
    assert fast.times.size == round(PERIOD * 1000)


def test_zero_is_the_trigger():
    averaged = average_beats(trace(np.full(4, PERIOD)), PERIOD)
    assert averaged.end_diastolic == pytest.approx(wave(0.0), rel=0.05)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: average_beats(trace(with_ecg=False), PERIOD), "neither trigger nor upstroke"),
        (lambda: average_beats(trace(), 1.1), r"0\.83. s.*1\.100 s"),
        (lambda: trace(rate=40.0), "0.02 s"),
        (lambda: PressureTrace(np.array([0.0, 0.01, 0.01]), np.full(3, 1e3)), "expected increasing times"),
        (lambda: PressureTrace(np.arange(9) * 0.01, np.full(9, np.nan)), "not finite"),
        (lambda: PressureTrace(np.arange(9) * 0.01, np.linspace(0.0, 16.0, 9)), "kPa or mmHg.*Pa"),
    ],
)
def test_an_invalid_recording_is_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_a_trigger_that_never_rises_is_refused():
    flat = trace(with_ecg=False)
    with pytest.raises(InputError, match="never rises"):
        average_beats(PressureTrace(flat.times, flat.pressures, np.zeros(flat.times.size)), PERIOD)
