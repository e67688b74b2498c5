"""Tidy tables: one number per row."""

import numpy as np
import pytest

from heartfit.results.exchange import curves_table, parameters_table


def test_every_belief_about_every_parameter_is_a_row(calibrated):
    table = parameters_table([calibrated]).set_index(["belief", "parameter"])
    assert len(table) == 6
    prior = table.loc[("prior", "mu")]
    assert (prior["median"], prior["unit"]) == (pytest.approx(9e3), "Pa.s")
    assert prior["high"] / prior["median"] == pytest.approx(np.exp(1.96 * 0.3), rel=1e-4)
    assert prior["low"] * prior["high"] == pytest.approx(prior["median"] ** 2)
    assert table.loc[("posterior", "mu"), "sd_of_ln"] < 0.3
    assert table.loc[("paper", "mu"), "median"] == pytest.approx(0.8 * 9e3, rel=1e-6)


def test_every_sample_of_every_curve_is_a_row(calibrated):
    table = curves_table([calibrated])
    assert set(table["kind"]) == {"measured", "calibrated"}
    assert len(table) == 40
    assert set(table["unit"]) == {"m^3"}
    assert table["value"].max() == pytest.approx(1.4e-4)
