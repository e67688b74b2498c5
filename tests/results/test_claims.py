"""Every number that the paper states has a row; ours is computed and the verdict follows from both."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.core.errors import InputError
from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.io.tables import read_published
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter
from heartfit.results.case import Groups
from heartfit.results.claims import FINDINGS, claimed_limits, claims_table
from heartfit.results.errors import PAPER
from heartfit.results.findings import PLANTED_PATIENTS, StudyResults
from heartfit.results.sensitivity import FOUR, SEVEN
from heartfit.results.text import render_tables
from heartfit.study.need import Cost
from tests.results.hearts import calibrated

PUBLISHED = Path(__file__).parents[2] / "resources" / "marchesseau2012"
CLAIMS = read_published(PUBLISHED / "claims.tsv")
GROUPS = Groups(("volunteer1", "volunteer2"), ("real",), ("lbbb1", "lbbb2"))


def costs(case: str, longest: float) -> list[Cost]:
    walls = {"draw_sigma_points": 6.0, "simulate_point_0": 30.0, "simulate_point_1": longest}
    walls |= {"update_parameters": 12.0, "simulate_calibrated": 42.0}
    return [Cost(f"{case}/locking/{job}", wall, wall, 100.0) for job, wall in walls.items()]


SELECTION = pd.DataFrame(
    {
        "setting": "locking",
        "observed": ["volume", "volume", "volume and pressure", "volume and pressure"],
        "chosen by": ["rule", PAPER] * 2,
        "parameters": ["sigma_0, c_1, mu, tau", ", ".join(FOUR), ", ".join(SEVEN), ", ".join(SEVEN)],
    }
)
FOURTEEN = Gaussian.from_relative(dict.fromkeys(PAPER_PARAMETERS, 1.0), dict.fromkeys(PAPER_PARAMETERS, 0.2))
SENSITIVITY = Sensitivity(FOURTEEN, ("V_min",), np.ones(1), np.zeros((14, 1)), np.zeros((14, 1)))
SLOPE_ERRORS = Scatter(("q_max", "q_min"), 21, np.array([0.1, -0.1]), np.diag([1e-6, 1e-6]))
NOISE = NoiseModel({}, SLOPE_ERRORS, {"lv_volume": SLOPE_ERRORS})
RESULTS = StudyResults(
    cases=[
        calibrated("volunteer1", errors=10.0, ratios={"sigma_0": 1.2}),
        calibrated("volunteer2", errors=16.0, ratios={"sigma_0": 0.8}),
        calibrated("real", errors=40.0),
        calibrated("lbbb1", errors=16.0, ratios={"sigma_0": 0.6}, pressure=True),
        calibrated("lbbb2", errors=4.0, ratios={"sigma_0": 0.7, "K": 1.5}, pressure=True),
    ],
    groups=GROUPS,
    costs=[
        cost for case in (*GROUPS.virtual, "real") for cost in costs(case, 300.0 if case == "lbbb1" else 60.0)
    ],
    sensitivities={"locking": SENSITIVITY},
    selection=[SELECTION],
    noise=[NOISE],
)


def ours(claim: str, hearts: str, results: StudyResults = RESULTS) -> tuple[str, str]:
    """Our number and the verdict in the one row of a claim and a group of hearts."""
    table = claims_table(CLAIMS[CLAIMS["claim"] == claim], results)
    (row,) = table.loc[table["hearts"] == hearts, ["ours", "verdict"]].to_numpy().tolist()
    return row[0], row[1]


def test_every_claim_has_a_source_and_every_source_a_claim() -> None:
    assert CLAIMS["claim"].tolist() == list(FINDINGS)
    assert set(claims_table(CLAIMS, RESULTS)["quote"]) == set(CLAIMS["quote"])


def test_claimed_numbers_are_those_of_the_published_tables() -> None:
    claimed = CLAIMS.set_index("claim")["value"]
    errors = read_published(PUBLISHED / "table1.csv").set_index("observation")
    parameters = read_published(PUBLISHED / "table2.csv").set_index("parameter").drop(columns="unit")
    for name, row in errors.iterrows():
        assert claimed[f"mean_{name}"] == row["mean"]
        assert claimed[f"largest_{name}"] == row.drop("mean").max()
    for name, row in parameters.iterrows():
        volunteers = row.drop("mean")
        assert claimed[f"mean_{name}"] == row["mean"]
        assert claimed[f"spread_{name}"] == pytest.approx(volunteers.max() / volunteers.min(), abs=0.005)
    means = parameters["mean"]
    assert claimed["stiffness_of_dilated"] == pytest.approx(claimed["K_of_dilated"] / means["K"], abs=0.005)
    limit = claimed["sigma_0_of_patients"] / means["sigma_0"]
    assert claimed["contractility_of_patients"] == pytest.approx(limit, abs=0.005)
    slopes = errors.loc[["q_max", "q_min"], "mean"].mean()
    assert claimed["registration_over_calibration"] == pytest.approx(25.0 / slopes, abs=0.005)
    assert claimed["mean_error"] == round((21 * errors["mean"].mean() + 12 * claimed["patients_error"]) / 33)
    assert claimed_limits(CLAIMS).stiff == claimed["stiffness_of_dilated"]


def test_errors_are_averaged_over_observations_and_measured_hearts_stand_alone() -> None:
    assert ours("mean_error", "4 virtual") == ("11", "met"), "(3 x 10 + 3 x 16 + 6 x 16 + 6 x 4) / 18 = 11"
    assert ours("mean_error", "real") == ("40", "not met")
    assert ours("patients_error", "2 virtual") == ("10", "met")
    assert ours("mean_q_min", "2 virtual") == ("13", "not met"), "over the paper's 12.66"
    assert ours("largest_q_max", "2 virtual") == ("16", "met")


def test_a_calibration_takes_its_longest_simulation_and_the_steps_about_it() -> None:
    assert ours("minutes", "4 virtual") == ("6", "met"), "(6 + 300 + 12 + 42) s of lbbb1"
    slow = replace(RESULTS, costs=[*costs("volunteer1", 1200.0), *RESULTS.costs[5:]])
    assert ours("minutes", "4 virtual", slow) == ("21", "not met")
    assert ours("iterations", "4 virtual") == ("1", "met")


def test_numbers_of_parameters_and_simulations_are_those_of_the_calibrations() -> None:
    assert ours("parameters_of_volume", "2 virtual") == ("4", "met")
    assert ours("parameters_of_pressure", "2 virtual") == ("7", "met")
    assert ours("simulations_of_volume", "real") == ("9", "met")
    assert ours("simulations_of_pressure", "2 virtual") == ("15", "met")
    assert ours("model_parameters", "") == ("14", "met")
    assert ours("selection_of_volume", "") == ("2", "not met")
    assert ours("selection_of_pressure", "") == ("7", "met")
    assert ours("priors", "4 virtual") == ("1", "met")
    shifted = [
        replace(case, prior=case.prior | {"mu": 1e3 * i}) for i, case in enumerate(RESULTS.cases, start=1)
    ]
    assert ours("priors", "4 virtual", replace(RESULTS, cases=shifted)) == ("4", "not met")


def test_patients_are_compared_over_the_mean_of_the_virtual_volunteers() -> None:
    weak = ours("contractility_of_patients", "2 virtual, sigma_0")
    assert weak == ("0.7", f"not comparable: {PLANTED_PATIENTS}"), "the less weak one decides"
    assert ours("stiffness_of_dilated", "lbbb2, K") == ("1.5", f"not comparable: {PLANTED_PATIENTS}")
    value, verdict = ours("K_of_dilated", "lbbb2")
    assert (value, verdict.partition(":")[0]) == ("0.75", "not comparable")
    assert ours("spread_sigma_0", "2 virtual")[0] == "1.5"


def test_measured_patients_are_judged_by_the_paper_s_limits() -> None:
    groups = RESULTS.groups
    people = replace(RESULTS, groups=replace(groups, patients=(), measured_patients=groups.patients))
    assert ours("contractility_of_patients", "lbbb1, lbbb2, sigma_0", people) == ("0.7", "not met")
    assert ours("stiffness_of_dilated", "lbbb2, K", people) == ("1.5", "met")


def test_the_spread_of_a_cohort_is_judged_unless_its_ratios_are_the_paper_s() -> None:
    value, verdict = ours("spread_sigma_0", "2 virtual")
    assert (value, verdict.partition(":")[0]) == ("1.5", "not comparable")
    drawn = replace(RESULTS, planted_ratios=False)
    assert ours("spread_sigma_0", "2 virtual", drawn) == ("1.5", "met"), "below 8.75 / 4.42"
    assert ours("mean_R_p", "2 virtual", drawn)[1].startswith("not comparable"), (
        "drawn about it in both cohorts"
    )


def test_registration_is_compared_with_known_motion_and_with_the_calibration() -> None:
    assert ours("registration_q_max", "21 image sequences") == ("10", "met")
    assert ours("registration_over_calibration", "2 virtual") == ("0.769", "met"), "10 % over 13 %"


def test_virtual_hearts_are_no_volunteers_and_what_is_missing_is_not_judged() -> None:
    assert ours("volunteers", "measured") == ("1", "not met")
    assert ours("volunteers", "virtual")[1].startswith("not comparable: virtual hearts")
    alone = replace(RESULTS, cases=RESULTS.cases[2:3], groups=Groups((), ("real",)), selection=[], noise=[])
    for claim in ("patients_error", "registration_q_max", "selection_of_volume", "stiffness_of_dilated"):
        assert ours(claim, "", alone) == ("", "not comparable: this study has no such hearts")
    failed = replace(RESULTS.cases[0], calibrated={})
    one = replace(RESULTS, cases=[failed], groups=Groups(("volunteer1",)))
    assert ours("mean_q_max", "1 virtual", one) == ("", "not comparable: the calibrated beat failed")


def test_an_unknown_claim_or_relation_is_refused() -> None:
    for column in ("claim", "relation"):
        with pytest.raises(InputError, match="expected one of"):
            claims_table(CLAIMS.assign(**{column: "nearly"}), RESULTS)


def test_long_steps_behind_a_number_are_named() -> None:
    far = calibrated("volunteer1", ratios={"sigma_0": 1.8, "K": 0.5})
    table = claims_table(CLAIMS, replace(RESULTS, cases=[far, *RESULTS.cases[1:]]))
    steps = table.set_index(["quantity", "hearts"])["long steps"]
    assert steps["mean error of V_min", "2 virtual"] == "volunteer1: sigma_0 +2.9, K -3.5"
    assert steps["mean sigma_0 of the volunteers", "2 virtual"] == "volunteer1: sigma_0 +2.9, K -3.5"
    assert steps["mean error of V_min", "real"] == ""
    assert steps["parameters estimated from a volume curve", "2 virtual"] == "", (
        "no step changes their number"
    )


def test_a_quote_is_printed_once_above_its_rows() -> None:
    table = claims_table(CLAIMS, RESULTS)
    rendered = render_tables({"claims": table})["claims"]
    assert rendered.frame is table
    quote = "The mean relative error for both cases is about 16%"
    assert rendered.markdown.count(quote) == 1
    assert len(rendered.markdown.splitlines()) >= len(table) + 2
    assert rendered.markdown.count("a mean relative error from the real data of 11%") == 1
