"""Evaluation of named effects: units, held-out ratios and the bias of the parameters."""

import numpy as np
import pytest

from heartfit.results.discovery import DiscoveryResult, discovery_table

CAUSE = {
    "verdict": "named",
    "mechanisms": [
        {
            "name": "MitralRegurgitation",
            "ln_bayes_factor": 21.5,
            "amplitude": 0.4e-4,
            "unit": "m^2",
            "interval": [0.3e-4, 0.5e-4],
        }
    ],
    "gain": [{"curve": "lv_pressure", "ratio": 0.5}, {"curve": "rv_volume", "ratio": 1.1}],
    "ranking": {"MitralRegurgitation": 21.5, "unknown": 3.0},
    "simulations": 2100,
}
TRUTH = {"sigma_0": 200e3, "R_p": 1e8}
PLANTED = [("MitralRegurgitation", 0.45e-4, "m^2")]


def test_a_row_gives_the_planted_effect_the_named_effect_and_the_gain() -> None:
    before = {"sigma_0": 220e3, "R_p": 1e8 * np.exp(0.2), "K": 5e5}
    case = DiscoveryResult("leak1", "physical", CAUSE, before, dict(TRUTH), PLANTED, TRUTH)
    row = discovery_table([case]).iloc[0]
    assert row["planted"] == "MitralRegurgitation 0.45 cm²"
    assert row["named"] == "MitralRegurgitation 0.4 cm² (0.3 cm² to 0.5 cm²)"
    assert row["LV pressure ratio"] == 0.5
    assert np.isnan(row["LV volume ratio"])
    assert row["bias before (%)"] == pytest.approx(100.0 * np.sqrt((np.log(1.1) ** 2 + 0.04) / 2.0))
    assert row["bias after (%)"] == 0.0


def test_without_a_named_effect_the_best_of_the_ranking_is_listed() -> None:
    cause = CAUSE | {"verdict": "none", "mechanisms": [], "ranking": {"unknown": 1.5, "Pericardium": 0.3}}
    row = discovery_table([DiscoveryResult("sound1", "physical", cause, {}, {}, [], {})]).iloc[0]
    assert (row["planted"], row["named"], row["best of the ranking"], row["ln BF"]) == (
        "",
        "",
        "unknown",
        1.5,
    )
    assert np.isnan(row["bias before (%)"])
