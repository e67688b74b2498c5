"""A finding may not be lost, wherever the study runs: the name of a hidden effect, and "none" of a sound heart."""

import pandas as pd
import pytest

from heartfit.core.errors import InputError
from heartfit.results.found import HIDDEN, SAID, require_findings

NAMED, NONE = "named: aortic stenosis", "none"


def findings(**cases: tuple[str, str]) -> dict[str, pd.DataFrame]:
    """Return the table of discovery of cases with their hidden effects and verdicts."""
    rows = [
        {"case": case, "quantity": quantity, "text": text}
        for case, texts in cases.items()
        for quantity, text in zip((HIDDEN, SAID), texts, strict=True)
    ]
    return {"discovery": pd.DataFrame(rows, columns=["case", "quantity", "text"])}


STENOSIS = "aortic stenosis, 13.6 kPa (3.4 scales)"
STORED = findings(hidden1=(STENOSIS, NAMED), sound1=("nothing", NONE))


def test_the_stored_findings_and_better_ones_pass() -> None:
    require_findings(STORED, STORED)
    require_findings(findings(hidden1=(STENOSIS, "unknown"), sound1=("nothing", NONE)), STORED)
    require_findings({}, STORED)
    further = findings(hidden1=("aortic stenosis, 9.1 kPa (2.3 scales)", NAMED), sound1=("nothing", NONE))
    require_findings(STORED, further)


@pytest.mark.parametrize(
    ("tables", "case"),
    [
        (findings(hidden1=(STENOSIS, NONE), sound1=("nothing", NONE)), "hidden1"),
        (findings(hidden1=(STENOSIS, "named: mitral stenosis"), sound1=("nothing", NONE)), "hidden1"),
        (
            findings(hidden1=(STENOSIS, "unknown (withdrawn: aortic stenosis)"), sound1=("nothing", NONE)),
            "hidden1",
        ),
        (
            findings(
                hidden1=(STENOSIS, "unknown (candidate, not named: aortic stenosis and catheter delay)"),
                sound1=("nothing", NONE),
            ),
            "hidden1",
        ),
        (findings(hidden1=(STENOSIS, NAMED), sound1=("nothing", NAMED)), "sound1"),
        (findings(hidden1=(STENOSIS, NAMED)), "sound1"),
        ({}, "hidden1"),
    ],
    ids=[
        "not detected",
        "another name",
        "withdrawn",
        "candidate",
        "a sound heart is named",
        "not searched",
        "no table",
    ],
)
def test_a_lost_finding_is_an_error(tables: dict[str, pd.DataFrame], case: str) -> None:
    with pytest.raises(InputError, match=f"a finding is lost: .*{case}"):
        require_findings(STORED, tables)


def test_both_effects_of_a_pair_must_be_named() -> None:
    pair = f"{STENOSIS}; mitral regurgitation, 0.3 cm² (2.0 scales)"
    both, one = (
        "two: mitral regurgitation and aortic stenosis",
        "named: mitral regurgitation (withdrawn: aortic stenosis)",
    )
    require_findings(findings(a=(pair, both)), findings(a=(pair, both)))
    with pytest.raises(InputError, match="a finding is lost"):
        require_findings(findings(a=(pair, both)), findings(a=(pair, one)))
