"""Rows carry the right numbers, units and floors; rows of different code are refused."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate
from heartfit.observation.curve import Curve
from heartfit.observation.noise import Observation
from heartfit.tables.case import CaseResult, summarise
from heartfit.tables.errors_table import PAPER, error_table
from heartfit.tables.fingerprints import FingerprintMismatchError
from heartfit.tables.parameters_table import parameter_table
from heartfit.tables.text import to_latex, to_markdown

OBSERVED = {"V_min": 72e-6, "q_max": 474e-6, "q_min": -520e-6}
PAPER_ERRORS = pd.DataFrame(
    {"observation": list(OBSERVED), "1": [0.35, 3.06, 0.31], "mean": [1.32, 11.85, 12.66]}
)
PAPER_PARAMETERS = pd.DataFrame(
    {
        "parameter": ["sigma_0", "mu", "K", "R_p"],
        "unit": ["MPa", "MPa.s", "MPa", "MPa.s/m^3"],
        "1": [6.49, 0.31, 14.22, 93.87],
        "mean": [5.8, 0.3, 12.9, 113.7],
    }
)


def case(name: str = "real", setting: str = "physical", factor: float = 1.1) -> CaseResult:
    return CaseResult(
        case=name,
        setting=setting,
        fingerprint="abc",
        observed=OBSERVED,
        noise={"V_min": 1.44e-6, "q_max": 47.4e-6, "q_min": 26e-6},
        reference={key: 1.3 * value for key, value in OBSERVED.items()},
        calibrated={key: factor * value for key, value in OBSERVED.items()},
        prior={"sigma_0": 240e3, "R_p": 1.14e8},
        prior_sd={"sigma_0": 0.2, "R_p": 0.2},
        estimate={"sigma_0": 250e3, "R_p": 1.1e8},
        estimate_sd={"sigma_0": 0.09, "R_p": 0.18},
        units={"sigma_0": "Pa", "R_p": "Pa.s/m^3"},
        failed_points=1,
        sigma_points=9,
        root_mean_square={"lv_volume": 6e-6, "rv_volume": 9e-6},
    )


def test_errors_stand_beside_their_floor_and_the_paper() -> None:
    table = error_table([case(), case("virtual", factor=0.8)], PAPER_ERRORS)
    first = table.iloc[0]
    assert first["V_min (%)"] == pytest.approx(10)
    assert first["q_min (%)"] == pytest.approx(10)
    assert first["V_min floor (%)"] == pytest.approx(2)
    assert first["q_max floor (%)"] == pytest.approx(10)
    assert first["prior mean (%)"] == pytest.approx(30)
    assert first["LV RMS (mL)"] == pytest.approx(6)
    assert first["failed points"] == "1 of 9"
    mean = table.set_index("case").loc["mean of 2"]
    assert mean["q_max (%)"] == pytest.approx(15)
    assert table[table["setting"] == PAPER]["case"].tolist() == ["volunteer 1", "mean of 7"]
    assert table.iloc[-1]["mean (%)"] == pytest.approx((1.32 + 11.85 + 12.66) / 3)


def test_the_sign_of_an_error_follows_the_magnitude_of_the_observation() -> None:
    assert case().errors()["q_max"] == pytest.approx(10)
    assert case().errors()["q_min"] == pytest.approx(-10)


def test_parameters_in_printed_units_with_prior_paper_and_truth() -> None:
    cases = [case(), case("virtual"), case(setting="paper")]
    table = parameter_table(cases, PAPER_PARAMETERS, {"virtual": {"sigma_0": 200e3, "hidden": 1.0}})
    assert table["case"].tolist()[:3] == ["prior", "real", "virtual"]
    assert table["sigma_0 (kPa)"].tolist() == pytest.approx([240, 250, 250, 240, 250, 6490, 5800])
    assert table["R_p (MPa.s/m^3)"].iloc[0] == pytest.approx(114)
    assert table["R_p (MPa.s/m^3)"].iloc[-1] == pytest.approx(113.7)
    assert table["sigma_0 sd (%)"].iloc[1] == pytest.approx(9)
    assert table["sigma_0 of truth (%)"].dropna().tolist() == pytest.approx([25])
    assert "R_p of truth (%)" not in table


@pytest.mark.parametrize(
    "make", [lambda c: error_table(c, PAPER_ERRORS), lambda c: parameter_table(c, PAPER_PARAMETERS)]
)
def test_rows_of_different_code_are_refused(make) -> None:
    with pytest.raises(FingerprintMismatchError, match="abc: real/physical; old: other/physical"):
        make([case(), replace(case("other"), fingerprint="old")])


def test_text_has_symbols_blanks_and_no_raw_special_characters() -> None:
    table = error_table([case("bivme_patient1")], PAPER_ERRORS)
    latex = to_latex(table)
    assert r"\toprule" in latex
    assert r"$V_{\min}$ (\%)" in latex
    assert r"bivme\_patient1" in latex
    assert "nan" not in latex.lower()
    assert "| real" in to_markdown(error_table([case()], PAPER_ERRORS))


def test_a_record_takes_everything_from_the_posterior_and_the_curves() -> None:
    prior = Gaussian.of_relative({"sigma_0": 240e3, "R_p": 1.14e8}, {"sigma_0": 0.2, "R_p": 0.1})
    outcomes = [{"V_min": float(np.exp(point.z.sum() / 10))} for point in sigma_points(prior)]
    posterior = calibrate(prior, [*outcomes[:-1], None], {"V_min": outcomes[0]["V_min"]})
    times = np.arange(25) * 0.033
    wave = Curve(times, 120e-6 + 50e-6 * np.cos(2 * np.pi * times / 0.825), 0.825)
    late = {"lv_volume": wave.shifted(-0.02)}
    record = summarise(
        {"case": "real", "setting": "physical", "fingerprint": "abc"},
        posterior,
        [Observation("V_min", outcomes[0]["V_min"], "m^3", 0.1)],
        {"reference": outcomes[0], "calibrated": outcomes[0]},
        {"measured": {"lv_volume": wave}, "calibrated": late},
        {"sigma_0": "Pa", "R_p": "Pa.s/m^3"},
        [True] * 4 + [False],
        {"EDV": 170e-6},
    )
    assert record.shift == pytest.approx(0.02, abs=1e-3)
    assert record.root_mean_square["lv_volume"] < 1e-6
    assert record.reference_root_mean_square == {}
    assert (record.failed_points, record.sigma_points) == (1, 5)
    assert record.prior == pytest.approx({"sigma_0": 240e3, "R_p": 1.14e8})
    assert "R_p-" in record.notes[0]
