"""Verdicts on hearts of other simulators: what is right depends on whether the model needs a mechanism."""

import numpy as np
import pytest

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.observation.curve import Curve
from heartfit.results.other_worlds import HEALTHY, MECHANISM, PARAMETERS, Judged, outcomes_table
from heartfit.synthetic.other_worlds import OtherHeart
from heartfit.synthetic.trial import ScoredDiagnosis

TIMES = np.arange(200) * 0.8 / 200
WAVE = np.cos(2.0 * np.pi * TIMES / 0.8)


def judged(illness: str, verdict: str, *names: str, misfit: float = 1.0) -> Judged:
    curves = Curve(TIMES, 100e-6 + 40e-6 * WAVE, 0.8), Curve(TIMES, 8e3 - 7e3 * WAVE, 0.8)
    heart = OtherHeart("elsewhere", 1, illness, "severe" if illness else "", *curves)
    causes = tuple(Cause(name, 9.0, 1.0, "1", (0.5, 1.5)) for name in names)
    return Judged(heart, ScoredDiagnosis(verdict, causes), {"lv_volume": misfit})


@pytest.mark.parametrize(
    ("illness", "verdict", "names", "kind", "outcome"),
    [
        ("", "none", (), HEALTHY, "right"),
        ("", "insufficient", (), HEALTHY, "right"),
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
    healthy, ill = table.to_dict("records")
    assert (healthy["number"], healthy["right"], healthy["unknown"], healthy["wrong"]) == (3, 1, 1, 1)
    assert healthy["right (%)"] == "1 to 91", "Clopper and Pearson: 1 of 3"
    assert healthy["lv_volume residual over noise"] == "3.0"
    assert (ill["hearts"], ill["unknown"], ill["right (%)"]) == (MECHANISM, 1, "0 to 98")
