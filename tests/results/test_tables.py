"""Rows carry the right numbers, units and floors; rows of different code are refused."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import observe_measured
from heartfit.observation.operator import operators
from heartfit.results.case import CaseResult, FingerprintMismatchError, Groups, summarise
from heartfit.results.errors import PAPER, error_table, plausibility_table
from heartfit.results.parameters import parameter_table
from heartfit.results.text import to_latex, to_markdown

HEALTHY = Groups(("real", "virtual", "b", "c", "d"))
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
    table = error_table([case(), case("virtual", factor=0.8)], PAPER_ERRORS, HEALTHY)
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


def test_each_setting_has_the_mean_of_its_completed_cases() -> None:
    cases = [case(factor=1.1), case("b", factor=1.3), case("c", setting="locking", factor=1.5)]
    failed = replace(case("d", setting="locking"), calibrated={}, root_mean_square={})
    table = error_table([*cases, failed], PAPER_ERRORS, HEALTHY)
    means = table[table["case"].str.startswith("mean of")].set_index("setting")
    assert means.loc["physical", "V_min (%)"] == pytest.approx(20)
    assert means.loc["locking", "V_min (%)"] == pytest.approx(50)
    assert means.loc["locking", "case"] == "mean of 1"


def test_a_fit_below_the_noise_is_flagged_and_patients_are_left_out():
    groups = Groups(("virtual",), ("real",), ("sick",))
    table = error_table([case(factor=1.06), case("virtual"), case("sick")], PAPER_ERRORS, groups)
    rows = table[table["setting"] == "physical"].set_index("case")
    assert rows.index.tolist() == ["real", "virtual", "mean of 1", "mean of 2 with real"]
    assert rows.loc["real", "below noise"] == "q_max", "an error of 6 %, floors of 2, 10 and 5 %"
    assert rows.loc["real", "V_min z"] == pytest.approx(3)
    assert rows.loc["mean of 1", "V_min (%)"] == pytest.approx(10)
    assert rows.loc["mean of 2 with real", "V_min (%)"] == pytest.approx(8)


def test_the_sign_of_an_error_follows_the_magnitude_of_the_observation() -> None:
    assert case().errors()["q_max"] == pytest.approx(10)
    assert case().errors()["q_min"] == pytest.approx(-10)


def test_parameters_in_printed_units_with_prior_paper_and_truth() -> None:
    cases = [case(), case("virtual"), case(setting="locking")]
    table = parameter_table(cases, PAPER_PARAMETERS, HEALTHY, {"virtual": {"sigma_0": 200e3, "hidden": 1.0}})
    assert table["case"].tolist()[:3] == ["prior", "real", "virtual"]
    assert table["sigma_0 (kPa)"].tolist() == pytest.approx([240, 250, 250, 240, 250, 6490, 5800])
    assert table["R_p (MPa.s/m^3)"].iloc[0] == pytest.approx(114)
    assert table["R_p (MPa.s/m^3)"].iloc[-1] == pytest.approx(113.7)
    assert table["sigma_0 sd (%)"].iloc[1] == pytest.approx(9)
    assert table["sigma_0 of truth (%)"].dropna().tolist() == pytest.approx([25])
    assert "R_p of truth (%)" not in table
    assert table["sigma_0 planted over mean"].dropna().tolist() == [1.0]
    assert table["longest step (prior sd)"].iloc[1] == pytest.approx(np.log(250 / 240) / 0.2)
    sigma = [place for place, column in enumerate(table.columns) if column.startswith("sigma_0")]
    assert sigma == [4, 5, 6, 7, 8]
    assert table["sigma_0 over mean"].dropna().tolist() == pytest.approx([1, 1, 1, 6.49 / 5.8, 1])


@pytest.mark.parametrize(
    "make",
    [
        lambda c: error_table(c, PAPER_ERRORS, HEALTHY),
        lambda c: parameter_table(c, PAPER_PARAMETERS, HEALTHY),
    ],
)
def test_rows_of_different_code_are_refused(make) -> None:
    with pytest.raises(FingerprintMismatchError, match=r"abc.*real/physical.*old.*other/physical"):
        make([case(), replace(case("other"), fingerprint="old")])


def test_text_has_symbols_blanks_and_no_raw_special_characters() -> None:
    table = error_table([case("bivme_patient1")], PAPER_ERRORS, Groups(("bivme_patient1",)))
    latex = to_latex(table)
    assert r"\toprule" in latex
    assert r"$V_{\min}$ (\%)" in latex
    assert r"bivme\_patient1" in latex
    assert "nan" not in latex.lower()
    assert "| real" in to_markdown(error_table([case()], PAPER_ERRORS, HEALTHY))


def wave(late: float = 0.0, size: float = 50e-6) -> dict[str, Curve]:
    times = np.arange(50) * 0.0165
    return {"lv_volume": Curve(times, 120e-6 + size * np.cos(2 * np.pi * (times - late) / 0.825), 0.825)}


def record(calibrated: dict[str, Curve]) -> CaseResult:
    features = operators(wave(), frames=25)
    measurement = observe_measured(wave(), features)
    prior = Gaussian.from_relative(
        {"sigma_0": 240e3, "mu": 7e3, "R_p": 1.14e8}, {"sigma_0": 0.2, "mu": 0.2, "R_p": 0.1}
    )
    observed = measurement.values
    outcomes = [
        {
            name: value * float(np.exp(point.z[i] - prior.mean[i]))
            for i, (name, value) in enumerate(observed.items())
        }
        for point in sigma_points(prior)
    ]
    posterior = calibrate(prior, [*outcomes[:-1], "inverted"], observed)
    return summarise(
        {"case": "real", "setting": "physical", "fingerprint": "abc"},
        posterior,
        measurement,
        {"measured": wave(), "reference": wave(size=40e-6), "calibrated": calibrated},
        features,
        {"sigma_0": "Pa", "mu": "Pa.s", "R_p": "Pa.s/m^3"},
        {"wall_volume_loss": 0.02},
    )


def test_a_record_takes_everything_from_the_posterior_and_the_curves() -> None:
    row = record(wave(late=0.02))
    assert row.shift == pytest.approx(0.02, abs=1e-3)
    assert row.root_mean_square["lv_volume"] < 0.1e-6
    assert row.reference_root_mean_square["lv_volume"] == pytest.approx(10e-6 / np.sqrt(2), rel=1e-2)
    assert (row.failed_points, row.sigma_points) == (1, 7)
    assert row.prior == pytest.approx({"sigma_0": 240e3, "mu": 7e3, "R_p": 1.14e8})
    assert "R_p-" in row.notes[0]
    assert row.reference_errors()["q_max"] == pytest.approx(-20, abs=0.1)
    assert abs(row.errors()["V_min"]) < 1
    assert row.guards["wall_volume_loss"] == 0.02
    assert row.guards["lv_EDV_error_percent"] == pytest.approx(0.0, abs=0.05), (
        "a shift in time does not change the error"
    )
    smaller = record(wave(size=40e-6)).guards
    assert smaller["lv_EDV_error_percent"] == pytest.approx(-100 * 10 / 170, rel=0.01)
    assert smaller["lv_ESV_error_percent"] == pytest.approx(100 * 10 / 70, rel=0.01)


def test_a_long_step_is_named_in_the_tables_of_errors_and_parameters() -> None:
    far = replace(
        case("virtual"), estimate={"sigma_0": 240e3 * np.exp(0.2 * 2.7), "R_p": 1.14e8 * np.exp(-0.2 * 2.4)}
    )
    assert far.steps() == pytest.approx({"sigma_0": 2.7, "R_p": -2.4})
    for table in (
        error_table([case(), far], PAPER_ERRORS, HEALTHY),
        parameter_table([case(), far], PAPER_PARAMETERS, HEALTHY),
    ):
        flags = table.set_index("case")["long steps"]
        assert flags["virtual"] == "sigma_0 +2.7", "2.4 is within 2.5"
        assert set(flags.drop("virtual")) == {""}


def test_a_failed_verification_is_a_row_without_errors() -> None:
    row = record({})
    assert np.isnan(list(row.errors().values())).all()
    assert "nan" not in to_markdown(error_table([row], PAPER_ERRORS, HEALTHY))


def test_plausibility_prints_what_the_record_holds():
    guards = {
        "lv_EDV_error_percent": -2.0,
        "rv_ESV_error_percent": 7.5,
        "lv_peak_pressure": 15.5e3,
        "wall_volume_loss": 0.024,
        "beats": 3.0,
        "drift": 0.004,
    }
    whole = replace(case(), guards=guards, shift=0.013, notes=("one", "two"))
    table = plausibility_table([whole, replace(case("failed"), guards={})])
    assert table["LV EDV (%)"][0] == -2.0
    assert table["RV ESV (%)"][0] == 7.5
    assert table["LV peak (kPa)"][0] == pytest.approx(15.5)
    assert table["wall volume loss (%)"][0] == pytest.approx(2.4)
    assert table["drift (%)"][0] == pytest.approx(0.4)
    assert table["trigger shift (ms)"][0] == pytest.approx(13.0)
    assert table["notes"][0] == "one; two"
    assert table.loc[1].drop(["setting", "case", "trigger shift (ms)", "notes"]).isna().all()


def test_plausibility_refuses_rows_of_different_code():
    with pytest.raises(FingerprintMismatchError):
        plausibility_table([case(), replace(case("other"), fingerprint="other")])


def test_a_setting_of_the_measured_heart_has_its_own_columns_and_no_mean() -> None:
    groups = Groups(("virtual",), ("real",))
    right = {f"{name}_rv": 0.9 * value for name, value in OBSERVED.items()}
    both = replace(
        case(setting="both"),
        observed=OBSERVED | right,
        noise=dict.fromkeys([*OBSERVED, *right], 1e-6),
        reference=OBSERVED | right,
        calibrated=OBSERVED | {name: 1.2 * value for name, value in right.items()},
    )
    table = error_table([case(), case("virtual"), both], PAPER_ERRORS, groups)
    assert table[table["setting"] == "both"]["case"].tolist() == ["real"]
    row = table[table["setting"] == "both"].iloc[0]
    assert [row[f"{name}_rv (%)"] for name in OBSERVED] == pytest.approx([20.0] * 3)
    assert row["mean (%)"] == pytest.approx(10.0)
    assert table[table["setting"] == "physical"]["V_min_rv (%)"].isna().all()
