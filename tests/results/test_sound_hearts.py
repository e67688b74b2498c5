"""Each curve of a sound heart in the stored tables is explained to within its noise, the right volume too."""

from pathlib import Path

import pandas as pd
import pytest

from heartfit.discovery.sphere_model.cause import SMALLEST_P

REFERENCE = Path(__file__).parents[2] / "resources" / "reference"
CURVES = ("left ventricular volume", "left ventricular pressure", "right ventricular volume")


@pytest.mark.parametrize("study", ["study", "smoke"])
def test_no_curve_of_a_sound_heart_is_missed_by_more_than_its_noise(study: str) -> None:
    table = pd.read_csv(REFERENCE / study / "discovery.csv")
    sound = table[(table.quantity == "hidden") & (table.text == "nothing")].case
    assert len(sound)
    for case in sound:
        values = table[table.case == case].set_index("quantity")["value"]
        assert min(values[f"chi-squared: {curve}, without a mechanism"] for curve in CURVES) > SMALLEST_P
