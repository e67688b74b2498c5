"""Order of the page: a single heart first, findings before tables, the paper's tables in its own study only."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.residual import unbiased_with_noise
from heartfit.results.report.contents import contents
from heartfit.results.report.misfit import distance
from heartfit.results.report.page import render
from heartfit.results.report.parameters import estimates
from heartfit.results.report.record import ReportTable, StudyRecord
from tests.printed import numbers_in
from tests.results.report.conftest import ASSETS
from tests.results.report.small_report import SETTING, study


@pytest.fixture(scope="module")
def paper(ventricle: VentricularMesh) -> StudyRecord:
    """A virtual and a measured heart with a table of the paper and one of costs."""
    whole = study(ventricle)
    costs = ReportTable.of("costs", pd.DataFrame({"stage": ["simulation"], "time (s)": [12.0]}))
    return replace(whole, tables={**whole.tables, "costs": costs})


@pytest.fixture(scope="module")
def own(paper: StudyRecord) -> StudyRecord:
    """The study of one measured heart."""
    heart = replace(paper.cases["heart1"], kind="measured")
    return replace(paper, cases={"heart1": heart})


@pytest.fixture(scope="module")
def own_page(own: StudyRecord) -> str:
    return render(own, ASSETS)


def places(page: str, *identities: str) -> list[int]:
    """Places in the page at which the elements of these identities begin."""
    return [page.index(f'id="{identity}"') for identity in identities]


def test_one_heart_comes_first_and_provenance_last(own_page: str) -> None:
    within = ("heart", "curves", "misfit", "mechanisms", "parameters")
    order = ["heart1", *(f"heart1-{part}" for part in within), "discovery", "checks", "provenance"]
    assert places(own_page, *order) == sorted(places(own_page, *order))
    assert own_page.index('<section id="heart1"') == own_page.index("<section")
    assert "<h1>1 heart, measured" in own_page
    assert "1 hearts" not in own_page


def test_the_page_of_an_own_heart_does_not_compare_it_with_the_paper(own: StudyRecord, own_page: str) -> None:
    assert "table1" in own.tables
    assert "Marchesseau et al. 2012" not in own_page
    assert 'id="tables"' not in own_page
    (table,) = re.findall(r'aria-label="Parameters of heart1".*?</table>', own_page, re.DOTALL)
    assert "calibrated beat" in table
    assert "truth" not in table


def test_the_paper_is_compared_after_what_was_found(paper: StudyRecord, page: str) -> None:
    order = [part.name for part in contents(paper)]
    assert order == ["cohort", "discovery", "parameters", "cases", "tables", "checks", "provenance"]
    assert places(page, "cohort", "discovery", "heart1", "heart2", "tables", "provenance") == sorted(
        places(page, "cohort", "discovery", "heart1", "heart2", "tables", "provenance")
    )
    assert "<h1>2 hearts, measured" in page


def test_a_study_without_findings_and_tables_has_no_part_for_them(own: StudyRecord) -> None:
    names = [part.name for part in contents(replace(own, discoveries=(), tables={}))]
    assert names == ["heart1", "provenance"]


def test_the_distance_of_the_curves_is_in_units_of_noise(own: StudyRecord, own_page: str) -> None:
    """Without a shift the calibrated volume is 3 mL too large where the wave is 1: a multiple of the wave."""
    case = own.cases["heart1"]
    fit = replace(case.fits[SETTING], result=replace(case.fits[SETTING].result, shift=0.0))
    measured = case.measured["lv_volume"]
    _, noise = unbiased_with_noise("lv_volume", measured, [])
    error = (fit.calibrated["lv_volume"].values - measured.values) / noise
    assert error.max() * noise[0] == pytest.approx(3e-6)
    expected = np.sqrt(np.mean(error**2))
    printed = distance(case, fit).split(", ")
    assert numbers_in(printed[0]) == pytest.approx([expected], abs=0.05)
    assert [text.rsplit(" ", 1)[0] for text in printed] == [
        "left ventricular volume",
        "right ventricular volume",
        "left ventricular pressure",
    ]
    assert numbers_in(printed[2]) == [0.0], "the same pressure"
    assert distance(case, replace(fit, calibrated={})) == ""
    assert distance(case, case.fits[SETTING]) in own_page


def test_one_estimate_is_the_answer_and_the_beat_outside_its_interval_is_marked(own: StudyRecord) -> None:
    fit = own.cases["heart1"].fits[SETTING]
    answer = fit.card.noise_aware.estimate
    first, second = estimates(fit)
    assert (first.name, first.unit, second.name) == ("sigma_0", "kPa", "mu")
    assert first.median == pytest.approx(answer.physical()["sigma_0"] / 1e3)
    assert np.log([first.low, first.high]) == pytest.approx(
        answer.mean[0] - np.log(1e3) + 1.96 * answer.sd[0] * np.array([-1, 1])
    )
    assert first.beat == pytest.approx(fit.result.estimate["sigma_0"] / 1e3)
    assert first.reduction == pytest.approx(1 - (answer.sd[0] / fit.card.prior.sd[0]) ** 2)
    assert not first.informed
    assert first.truth == pytest.approx(250.0)
    assert first.holds_beat
    result = replace(fit.result, estimate={"sigma_0": 900e3, "mu": 7e3})
    far = replace(fit, result=result, searched=None, proved=None)
    assert [estimate.holds_beat for estimate in estimates(far)] == [False, True]
    case = replace(own.cases["heart1"], fits={SETTING: far}, walls={})
    page = render(replace(own, cases={"heart1": case}, discoveries=()), ASSETS)
    assert re.findall(r'<span class="outside">([^<]*), outside</span>', page) == ["900"]
