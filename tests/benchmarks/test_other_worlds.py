"""Verdicts on hearts of other simulators: what is right depends on whether the model needs a mechanism."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks.other_worlds.tables import (
    ALONE,
    HEALTHY,
    MECHANISM,
    PARAMETERS,
    Judged,
    changes_table,
    fits_table,
    hearts_table,
    outcomes_table,
    priors_table,
)
from heartfit.discovery.sphere_model.cause import Cause
from heartfit.observation.curve import Curve
from heartfit.synthetic.other_worlds import OtherHeart
from heartfit.synthetic.trial import ScoredDiagnosis

TIMES = np.arange(200) * 0.8 / 200
WAVE = np.cos(2.0 * np.pi * TIMES / 0.8)


def judged(illness: str, verdict: str, *names: str, misfit: float = 1.0) -> Judged:
    curves = Curve(TIMES, 100e-6 + 40e-6 * WAVE, 0.8), Curve(TIMES, 8e3 - 7e3 * WAVE, 0.8)
    heart = OtherHeart("elsewhere", 1, illness, "severe" if illness else "", *curves)
    causes = tuple(Cause(name, 9.0, 1.0, "1", (0.5, 1.5)) for name in names)
    return Judged(heart, ALONE, ScoredDiagnosis(verdict, causes), {"lv_volume": misfit}, 1.0)


@pytest.mark.parametrize(
    ("illness", "verdict", "names", "kind", "outcome"),
    [
        ("", "none", (), HEALTHY, "right"),
        ("", "insufficient", (), HEALTHY, "right"),
        ("", "model", (), HEALTHY, "right"),
        ("", "unknown", (), HEALTHY, "unknown"),
        ("", "named", ("Scar",), HEALTHY, "wrong"),
        ("weak ventricle", "none", (), PARAMETERS, "right"),
        ("weak ventricle", "two", ("Scar", "CatheterDelay"), PARAMETERS, "wrong"),
        ("mitral stenosis", "named", ("MitralStenosis",), MECHANISM, "right"),
        ("mitral stenosis", "group", ("CatheterDelay", "MitralStenosis"), MECHANISM, "right"),
        ("mitral stenosis", "named", ("CatheterDelay",), MECHANISM, "wrong"),
        ("mitral stenosis", "none", (), MECHANISM, "nothing"),
        ("mitral stenosis", "unknown", (), MECHANISM, "unknown"),
    ],
)
def test_an_outcome_is_that_of_the_verdict_on_this_heart(
    illness: str, verdict: str, names: tuple[str, ...], kind: str, outcome: str
) -> None:
    one = judged(illness, verdict, *names)
    assert (one.kind, one.outcome) == (kind, outcome)


def test_outcomes_are_counted_by_kind_with_an_exact_interval() -> None:
    table = outcomes_table(
        [
            judged("", "none"),
            judged("", "unknown", misfit=3.0),
            judged("", "named", "Scar", misfit=5.0),
            judged("mitral stenosis", "unknown"),
        ]
    )
    healthy, ill, all_healthy, _ = table.to_dict("records")
    assert (healthy["number"], healthy["right"], healthy["unknown"], healthy["wrong"]) == (3, 1, 1, 1)
    assert healthy["right (%), 95 % CI"] == "1 to 91", "Clopper and Pearson: 1 of 3"
    assert (ill["hearts"], ill["unknown"], ill["right (%), 95 % CI"]) == (MECHANISM, 1, "0 to 98")
    assert (all_healthy["simulator"], all_healthy["number"]) == ("all", 3)


def test_changes_are_counted_by_severity_and_illness_with_sums() -> None:
    stenosis, weak = judged("mitral stenosis", "unknown"), judged("weak ventricle", "none")
    named = judged("mitral stenosis", "named", "MitralStenosis")
    moderate = replace(named, heart=replace(named.heart, severity="moderate"))
    table = changes_table([stenosis, weak, named, moderate])
    rows = {(row["severity"], row["illness"]): row for row in table.to_dict("records")}
    assert list(rows) == [
        *(("moderate", illness) for illness in ("mitral stenosis", MECHANISM)),
        *(("severe", illness) for illness in ("mitral stenosis", "weak ventricle", PARAMETERS, MECHANISM)),
        *(("all", illness) for illness in (PARAMETERS, MECHANISM, "all")),
    ]
    severe, everything = rows["severe", "mitral stenosis"], rows["all", "all"]
    assert (severe["number"], severe["right"], severe["unknown"]) == (2, 1, 1)
    assert (everything["number"], everything["right"], everything["wrong"]) == (4, 3, 0)


def test_fits_are_medians_of_healthy_hearts() -> None:
    hearts = [judged("", "none", misfit=size) for size in (1.0, 3.0, 5.0)]
    (row,) = fits_table([*hearts, judged("weak ventricle", "none", misfit=99.0)]).to_dict("records")
    assert row["healthy hearts"] == 3
    assert row["left ventricular volume, over noise"] == "3.0"


def test_a_heart_is_listed_with_its_verdict_and_the_best_mechanisms() -> None:
    (row,) = hearts_table([judged("mitral stenosis", "named", "MitralStenosis")]).to_dict("records")
    assert (row["heart"], row["named"], row["outcome"]) == (
        "severe mitral stenosis",
        "mitral stenosis",
        "right",
    )


def test_the_priors_of_the_page_are_those_of_the_code() -> None:
    stored = Path(__file__).parents[2] / "docs" / "measured" / "other_worlds_priors.tsv"
    assert stored.read_text().split("\n", 1)[1] == priors_table().to_csv(sep="\t", index=False)
