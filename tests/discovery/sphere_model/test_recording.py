"""Invalid recordings are refused in one line with advice."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.recording import Recording, Samples

TIMES = np.arange(25) * 0.033
VOLUME = Samples(TIMES, 120e-6 + 50e-6 * np.cos(2 * np.pi * TIMES / 0.825))
PRESSURE = Samples(TIMES, 8e3 - 7e3 * np.cos(2 * np.pi * TIMES / 0.825))


def test_the_left_ventricle_explains_all_but_the_right_one():
    recording = Recording(0.825, {"rv_volume": VOLUME, "lv_pressure": PRESSURE, "lv_volume": VOLUME})
    assert recording.searched == ("lv_volume", "lv_pressure")
    assert recording.end_diastolic_volume() == pytest.approx(170e-6, rel=0.01)


@pytest.mark.parametrize(
    ("times", "values", "expected"),
    [
        ([0.0, 0.2, 0.1], [1.0, 2.0, 3.0], "sort"),
        ([0.0, 0.1], [1.0, 2.0, 3.0], "one value"),
        ([0.0, 0.1], [1.0, np.nan], "finite"),
    ],
)
def test_samples_are_refused(times, values, expected):
    with pytest.raises(InputError, match=expected):
        Samples(np.array(times), np.array(values))


@pytest.mark.parametrize(
    ("period", "curves", "expected"),
    [
        (0.825, {"lv_pressure": PRESSURE}, "no lv_volume"),
        (60.0, {"lv_volume": VOLUME}, "period = 60 s"),
        (1.6, {"lv_volume": VOLUME}, "record a whole beat"),
        (0.825, {"lv_volume": VOLUME.part(TIMES < 0.2)}, "at least 8"),
        (0.825, {"lv_volume": Samples(TIMES, 1e6 * VOLUME.values)}, "mL taken for m\\^3"),
        (0.825, {"lv_volume": VOLUME, "lv_pressure": Samples(TIMES, PRESSURE.values / 1e3)}, "kPa"),
        (0.825, {"lv_volume": VOLUME, "mitral_flow": VOLUME}, "leave it out"),
    ],
)
def test_recordings_are_refused(period, curves, expected):
    with pytest.raises(InputError, match=expected):
        Recording(period, curves)
