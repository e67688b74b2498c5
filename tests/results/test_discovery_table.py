"""Findings beside the answer: misfit in units of noise, size beside the hidden one, gains, bias of the parameters."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.sphere_model.cause import CurveFit, UnnamedCandidate
from heartfit.results.discovery import DiscoveryResult, discovery_table, printed_findings
from heartfit.synthetic.campaign import Effect
from tests.printed import numbers_in
from tests.results.report.small_report import WAVE, diagnosis

LEAK = Effect("MitralRegurgitation", 3.5e-5, 0.0, "m^2", 2.8)
TRUTH = {"sigma_0": 200e3, "mu": 7e3, "K": 1e6}


def proved(without, extended):
    card = diagnosis()
    (fitted,) = card.refitted.extension
    final = replace(fitted, amplitude=3.2e-5, interval=(2.6e-5, 3.8e-5))
    refitted = replace(card.refitted, none=without, extended=extended, from_all_samples=(final,))
    return replace(card, refitted=refitted)


def result(case="hidden1", hidden=(LEAK,), truth=TRUTH):
    without = {"sigma_0": 200e3 * np.exp(0.3), "mu": 7e3 * np.exp(-0.4), "K": 1.0}
    extended = {"sigma_0": 200e3, "mu": 7e3 * np.exp(0.1), "K": 2.0}
    return DiscoveryResult(case, "physical", diagnosis(), proved(without, extended), hidden, truth)


def numbers(discovery):
    return discovery_table([discovery]).frame.set_index("quantity")


def test_the_size_stands_beside_the_hidden_one_in_the_same_unit() -> None:
    frame = numbers(result())
    fitted = frame.loc["size of mitral regurgitation (cm²), fitted half of the samples"]
    assert (fitted["value"], fitted["low"], fitted["high"]) == pytest.approx((0.3, 0.2, 0.4))
    final = frame.loc["size of mitral regurgitation (cm²), all samples"]
    assert (final["value"], final["low"], final["high"]) == pytest.approx((0.32, 0.26, 0.38))
    assert frame.loc["size of mitral regurgitation (cm²), hidden", "value"] == pytest.approx(0.35)
    assert frame.loc["hidden", "text"] == "mitral regurgitation, 0.35 cm² (2.8 scales)"


def test_the_misfit_is_the_mean_of_a_phase_over_its_noise() -> None:
    """Two samples of 1 kPa noise each, where the simulation is 1 kPa too high at the peak."""
    wrong = numbers(result()).loc["misfit: left ventricular pressure"]
    size = 1e3 * WAVE[5:7].mean()
    assert wrong["value"] == pytest.approx(size / (1e3 / np.sqrt(2.0)))
    assert wrong["text"].startswith(f"{1e-3 * size:.2g} ± 0.71 kPa too high in early filling")
    assert "sd" in wrong["text"]


def test_the_bias_is_the_root_mean_square_of_the_logarithms_without_k() -> None:
    bias = numbers(result()).loc["bias of the parameters (%), without and with"]
    assert bias["low"] == pytest.approx(100.0 * np.sqrt((0.3**2 + 0.4**2) / 2.0))
    assert bias["value"] == pytest.approx(100.0 * 0.1 / np.sqrt(2.0))
    assert "error of K (%), without and with" not in numbers(result()).index


def test_a_measured_heart_has_neither_answer_nor_bias() -> None:
    frame = numbers(result("patient1", hidden=None, truth=None))
    assert not [name for name in frame.index if "hidden" in name or "bias" in name or "error of" in name]
    assert frame.loc["change of K (%)", "value"] == pytest.approx(100.0)
    ratio = frame.loc["error ratio: left ventricular pressure, legs_raised"]
    assert (ratio["value"], ratio["low"], ratio["high"]) == (0.5, 0.4, 0.7)


@pytest.mark.parametrize(
    ("verdict", "factors", "expected"),
    [
        ("named", {"MitralRegurgitation": 12.0}, (12.0, "mitral regurgitation")),
        ("group", {"SlowRelaxation": 9.0, "MitralRegurgitation": 11.0}, (11.0, "mitral regurgitation")),
        (
            "two",
            dict.fromkeys(("SlowRelaxation", "MitralRegurgitation"), 23.2),
            (23.2, "slow relaxation and"),
        ),
        ("unknown", {}, (24.3, "a Gaussian process")),
    ],
)
def test_the_factor_of_the_search_is_that_of_what_it_names(
    verdict: str, factors: dict[str, float], expected: tuple[float, str]
) -> None:
    """Not that of the Gaussian process, which may lead the ranking, nor that of a single mechanism of a pair."""
    cause = diagnosis().mechanisms[0]
    named = tuple(replace(cause, name=name, ln_bayes_factor=factor) for name, factor in factors.items())
    ranking = {"unknown": 24.3, "MitralRegurgitation": 12.0, "SlowRelaxation": 4.4}
    searched = replace(diagnosis(), verdict=verdict, mechanisms=named, ranking=ranking)
    frame = numbers(replace(result(), searched=searched))
    assert frame.loc["ln Bayes factor of the search", "value"] == expected[0]
    assert expected[1] in frame.loc["ln Bayes factor of the search", "text"]


def test_a_sound_heart_hides_nothing_and_is_not_extended() -> None:
    silent = replace(diagnosis(), verdict="none", mechanisms=(), refitted=None, gain=())
    sound = DiscoveryResult("sound1", "physical", silent, silent, (), TRUTH)
    frame = numbers(sound)
    assert frame.loc["hidden", "text"] == "nothing"
    assert frame.loc["verdict after the refit", "text"] == "none"
    assert not [name for name in frame.index if name.startswith(("size", "error ratio", "change"))]


def test_a_candidate_is_printed_as_not_named() -> None:
    causes = diagnosis().mechanisms
    beside = BesideProcess(12.0, -1.4, 0.0, 2.0, 4.0)
    unnamed = replace(
        diagnosis(), verdict="insufficient", mechanisms=(), candidate=UnnamedCandidate(causes, beside)
    )
    frame = numbers(DiscoveryResult("patient1", "physical", unnamed, unnamed))
    expected = "insufficient (candidate, not named: mitral regurgitation)"
    assert frame.loc["ln Bayes factor of the candidate", "value"] == 12.0
    assert "1.4 below" in frame.loc["ln Bayes factor of the candidate", "text"]
    assert [frame.loc[f"verdict {when}", "text"] for when in ("of the search", "after the refit")] == [
        expected
    ] * 2


def test_each_curve_of_a_refit_has_its_chi_squared_and_the_probability_of_more() -> None:
    right = CurveFit("rv_volume", 11.9, 19.1, 0.891)
    silent = replace(diagnosis(), verdict="none", mechanisms=(), refitted=None, gain=(), fits=(right,))
    frame = numbers(DiscoveryResult("sound1", "physical", silent, silent, (), TRUTH))
    row = frame.loc["chi-squared: right ventricular volume, without a mechanism"]
    assert row["value"] == pytest.approx(0.891)
    assert numbers_in(row["text"]) == [11.9, 19.1, 0.89]
    extended = replace(proved({"K": 1.0}, {"K": 2.0}), fits=(right,))
    extended = replace(extended, refitted=replace(extended.refitted, fits=(replace(right, p=0.3),)))
    frame = numbers(DiscoveryResult("hidden1", "physical", diagnosis(), extended, (LEAK,), TRUTH))
    rows = [name for name in frame.index if name.startswith("chi-squared")]
    assert frame.loc[rows, "value"].tolist() == pytest.approx([0.891, 0.3])


def test_cases_are_columns_in_print_with_one_row_for_each_finding() -> None:
    silent = replace(diagnosis(), verdict="none", mechanisms=(), refitted=None, gain=())
    printed = printed_findings([result(), DiscoveryResult("sound1", "physical", silent, silent, (), TRUTH)])
    assert list(printed.columns) == ["finding", "hidden1, physical", "sound1, physical"]
    assert printed["finding"].is_unique
    row = printed.set_index("finding").loc["size of mitral regurgitation (cm²), all samples"]
    assert list(row) == ["0.32 (0.26 to 0.38)", ""]


def test_a_withdrawn_name_is_listed_with_the_verdict() -> None:
    judged = replace(diagnosis(), verdict="unknown", mechanisms=(), withdrawn=("SlowRelaxation",))
    frame = numbers(DiscoveryResult("hidden1", "physical", diagnosis(), judged, (LEAK,), TRUTH))
    assert frame.loc["verdict after the refit", "text"] == "unknown (withdrawn: slow relaxation)"
