"""Numbers and names in readable form; no text of a table is executable in a browser."""

import math

import pandas as pd
import pytest

from heartfit.results.report.page import number, quantity, rows
from heartfit.results.report.record import ReportTable


@pytest.mark.parametrize(
    ("value", "text"), [(0.12345, "0.123"), (-3.0, "−3"), (123456.0, "123456"), (math.nan, "–"), (None, "–")]
)
def test_numbers_are_formatted(value: float | None, text: str) -> None:
    assert number(value) == text


def test_quantities_are_typeset() -> None:
    assert quantity("sigma_0 sd (%)") == "<i>σ</i><sub>0</sub> sd (%)"
    assert quantity("R_p (MPa.s/m^3)") == "<i>R</i><sub>p</sub> (MPa.s/m<sup>3</sup>)"
    assert quantity("dPdt_max (%)") == "d<i>P</i>/d<i>t</i><sub>max</sub> (%)"
    assert quantity("mean (%)") == "mean (%)"
    assert quantity("<b>_<i> <u>") == "<i>&lt;b&gt;</i><sub>&lt;i&gt;</sub> &lt;u&gt;"


def test_rows_are_classified_as_study_mean_or_paper() -> None:
    table = pd.DataFrame(
        {
            "setting": ["locking", "locking", "Marchesseau et al. 2012"],
            "case": ["heart1", "mean of 1", "volunteer 1"],
            "V_min (%)": [5.0, math.nan, 0.35],
        }
    )
    assert [row["kind"] for row in rows(table)] == ["ours", "mean", "paper"]
    assert [row["cells"][-1] for row in rows(table)] == ["5.00", "", "0.35"]


def test_a_number_among_words_is_printed_as_a_number() -> None:
    frame = pd.DataFrame({"setting": ["locking"] * 2, "value": ["16.86318149764966", "<4"]})
    (row, paper) = rows(ReportTable.of("table3_parameters", frame).frame)
    assert row["cells"][-1] == "16.9"
    assert paper["cells"][-1] == "<4"
    (as_text, _) = rows(ReportTable.of("table2_as_printed", frame).frame)
    assert as_text["cells"][-1] == "16.86318149764966", "this table is rounded already"
