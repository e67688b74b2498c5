"""The patients' table: six observations, seven parameters, and the paper's limits kept as limits."""

from dataclasses import replace

import pandas as pd
import pytest

from heartfit.results.case import Groups
from heartfit.results.errors import PAPER
from heartfit.results.patients import patient_errors, patient_parameters
from tests.results.small_study import CASES

GROUPS = Groups(("v1", "v2"), ("real",), ("lbbb1",))
PUBLISHED = pd.DataFrame(
    {
        "quantity": ["mean error", "sigma_0", "K"],
        "unit": ["%", "MPa", "MPa"],
        "1": ["16", "<4", None],
        "2": ["16", "<4", "19"],
        "healthy_mean": [None, 5.8, 12.9],
    }
)


TRUTHS = {
    "v1": {"sigma_0": 250e3, "K": 1.0},
    "v2": {"sigma_0": 270e3, "K": 1.0},
    "lbbb1": {"sigma_0": 156e3, "K": 1.0},
}


def test_errors_of_the_patients_only_with_their_mean_and_the_papers():
    table = patient_errors(CASES, PUBLISHED, GROUPS)
    ours = table[table["setting"] == "physical"].set_index("quantity")
    assert ours.index.tolist() == ["V_min", "dPdt_min", "mean"]
    assert ours["error (%)"].tolist() == pytest.approx([20.0, 4.0, 12.0])
    assert ours["below noise"].tolist() == ["", "yes", ""]
    assert ours.loc["V_min", "z"] == pytest.approx(4.0)
    assert ours.loc["mean", "prior error (%)"] == pytest.approx(50.0)
    assert table[table["setting"] == PAPER]["error (%)"].tolist() == [16.0, 16.0]


def test_parameters_stand_over_the_mean_of_the_virtual_volunteers_and_the_truths_over_theirs():
    table = patient_parameters(CASES, PUBLISHED, GROUPS, TRUTHS)
    ours = table[table["setting"] == "physical"].set_index("quantity")
    assert ours.loc["sigma_0", "healthy mean"] == pytest.approx(300.0), "kPa, without the measured heart"
    assert ours.loc["sigma_0", "over healthy mean"] == pytest.approx(0.6)
    assert ours.loc["sigma_0", "true over healthy mean"] == pytest.approx(0.6)
    assert pd.isna(ours.loc["K", "true over healthy mean"]), "no beat has a true K"
    paper = table[table["setting"] == PAPER]
    assert paper["over healthy mean"].tolist() == ["<0.69", "<0.69", "1.47"]
    assert paper["quantity"].tolist() == ["sigma_0", "sigma_0", "K"]


def test_a_long_step_of_a_patient_is_flagged_with_its_errors_and_its_parameter():
    far = [replace(CASES[-1], estimate=CASES[-1].estimate | {"K": CASES[-1].prior["K"] * 9.0}), *CASES[:-1]]
    errors = patient_errors(far, PUBLISHED, GROUPS).set_index(["setting", "case"])["long steps"]
    assert errors["physical"].unique().tolist() == ["sigma_0 -2.6, K +11.0"]
    parameters = patient_parameters(far, PUBLISHED, GROUPS)
    flags = parameters[parameters["setting"] == "physical"].set_index("quantity")["long steps"]
    assert flags.to_dict() == {"sigma_0": "†", "K": "†"}
    near = patient_parameters(CASES, PUBLISHED, GROUPS).set_index(["setting", "quantity"])["long steps"]
    assert near["physical", "K"] == ""


def test_a_setting_has_its_own_healthy_mean():
    other = [
        replace(case, setting="locking", estimate={"sigma_0": 2 * case.estimate["sigma_0"], "K": 1.0})
        for case in CASES
    ]
    table = patient_parameters([*CASES, *other], PUBLISHED, GROUPS)
    ratio = table[table["quantity"] == "sigma_0"].groupby("setting")["over healthy mean"].first()
    assert ratio["locking"] == ratio["physical"] == pytest.approx(0.6)


def test_a_cohort_without_patients_has_the_papers_rows():
    groups = Groups(("v1", "v2"))
    assert set(patient_errors(CASES[:2], PUBLISHED, groups)["setting"]) == {PAPER}
    assert set(patient_parameters(CASES[:2], PUBLISHED, groups)["setting"]) == {PAPER}
