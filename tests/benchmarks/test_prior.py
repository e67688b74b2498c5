"""The study's prior is what the beat of the mean healthy adult gives, and no heart of a cohort is."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from benchmarks.measured_table import read_table
from benchmarks.prior import (
    CONFIG,
    EDV,
    SETTINGS,
    beat_row,
    declared,
    fitted,
    forward_of,
    mean_adult,
    normal_beat,
)
from heartfit.calibration.unscented import Outcome
from heartfit.core.parameter import to_printed_unit
from heartfit.io.configuration import read_study

STUDY = read_study([Path(CONFIG)])


@pytest.mark.parametrize("name", SETTINGS)
def test_the_prior_in_use_is_the_stored_x0(name: str) -> None:
    table = read_table("prior")
    stored = table[table["setting"] == name].set_index("parameter")["X0"].astype(float)
    setting = STUDY.setting(name)
    units, used = setting.units(), setting.gaussian().physical()
    assert stored.index.tolist() == list(setting.estimate)
    for parameter, value in stored.items():
        assert to_printed_unit(used[parameter], units[parameter]) == pytest.approx(value, rel=1e-9)


def test_the_normal_beat_is_that_of_the_mean_adult() -> None:
    observed, errors = normal_beat()
    assert pytest.approx(0.5 * (160e-6 + 135e-6)) == EDV
    assert observed == pytest.approx(
        {"V_min": 0.36 * EDV, "q_max": 2.8 * EDV, "q_min": -3.3 * EDV, "P_max": 109.5 * 133.322}
    )
    assert errors["V_min"] == pytest.approx(0.07 / 31**0.5 * EDV, rel=0.05)
    assert errors["q_max"] == errors["q_min"] == pytest.approx(0.6 / 31**0.5 * EDV, rel=0.05)


def test_x0_meets_what_the_beat_determines_and_keeps_the_declared_rest() -> None:
    """Powers of sigma_0, mu and R_p alone: the solution is a triangular system of logarithms."""
    setting = declared(STUDY.settings["locking"])
    medians = setting.gaussian().physical()

    def forward(points: Sequence[Mapping[str, float]]) -> list[Outcome]:
        ratios = [{name: point[name] / medians[name] for name in medians} for point in points]
        return [
            {
                "V_min": 50e-6 * r["sigma_0"] ** -0.5,
                "q_max": 4e-4 * r["mu"] ** -0.4,
                "q_min": -5e-4 * r["sigma_0"] ** 0.5,
                "P_max": 14e3 * r["R_p"] ** 0.5,
            }
            for r in ratios
        ]

    truth = medians | {
        "sigma_0": 1.1 * medians["sigma_0"],
        "mu": 0.9 * medians["mu"],
        "R_p": 1.2 * medians["R_p"],
    }
    (observed,) = forward([truth])
    assert not isinstance(observed, str)
    errors = {name: 1e-4 * abs(value) for name, value in observed.items()}
    x0 = fitted(setting, forward, observed, errors).estimate
    assert x0.physical() == pytest.approx(truth, rel=1e-3)
    assert x0.sd[setting.estimate.index("K")] == pytest.approx(setting.gaussian().sd[2], rel=1e-6)
    assert np.all(x0.sd[[0, 1, 3]] < 0.01), "a twentieth of the declared ones"


@pytest.mark.long
def test_the_beat_at_x0_is_the_stored_one() -> None:
    setting = declared(STUDY.settings["locking"])
    x0 = STUDY.setting("locking").gaussian().physical()
    (outcome,) = forward_of(STUDY, mean_adult(STUDY), setting)([x0])
    table = read_table("prior_beat").set_index(["setting", "values"])
    stored, again = table.loc[("locking", "X0")], beat_row("locking", "X0", outcome)
    for quantity, cell in stored.items():
        assert float(again[str(quantity)]) == pytest.approx(float(cell), rel=0.01), (
            "another mesh moves it so far"
        )
