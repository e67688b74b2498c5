"""Recordings as data: averaged and unaveraged curves."""

import numpy as np
import pytest

from heartfit.discovery.sphere_model.recording import BIN, Recording, Samples, search_data

FRAMES = np.arange(25) * 0.04


def recording(times, values):
    volume = Samples(FRAMES, 1e-4 + 4e-5 * np.cos(2 * np.pi * FRAMES))
    return Recording(1.0, {"lv_volume": volume, "lv_pressure": Samples(times, values)})


def test_a_catheter_is_averaged_over_ten_milliseconds_of_the_phase():
    times = np.arange(3000) / 1000
    data = search_data(recording(times, 8e3 + 3e3 * np.floor(times)))
    _, pressure = data.blocks
    assert pressure.times == pytest.approx(BIN * np.arange(100) + 0.0045)
    assert data.values[25:] == pytest.approx(1.1e4)
    single = search_data(recording(times[:1000], 8e3 + 3e3 * times[:1000])).blocks[1].noise
    assert pressure.noise.levels == pytest.approx(np.array(single.levels) / np.sqrt(3), rel=1e-3)


def test_few_samples_and_frames_stay_as_they_are():
    times = np.arange(50) / 50
    data = search_data(recording(times, 1e4 + 1e3 * times))
    assert np.array_equal(data.blocks[0].times, FRAMES)
    assert np.array_equal(data.blocks[1].times, times)
