"""Pages print the stored results, which are the reference results of the study; each is printed."""

import importlib.util
import re
from pathlib import Path

import pytest

from heartfit.io.tables import read_published

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def pages():
    spec = importlib.util.spec_from_file_location("measured_pages", ROOT / "docs" / "measured_pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_pages_print_the_stored_results(pages):
    assert not pages.differences(), "python3 study.py numbers"


def test_stored_numbers_of_the_study_are_those_it_is_held_to(pages):
    """resources/reference/study is what `check_numbers` compares with the study."""
    numbers = read_published(ROOT / "resources" / "reference" / "study" / "numbers.csv").to_dict("records")
    expected = {"/".join(str(row[key]) for key in pages.KEY): row["value"] for row in numbers}
    _, *rows = pages.read_rows(pages.STUDY)
    stored = {row[3]: float(row[1]) for row in rows if row[3]}
    held = stored.keys() & expected.keys()
    assert len(held) >= 20
    printed = {number: float(f"{float(expected[number]):.4g}") for number in held}
    assert {number: stored[number] for number in held} == printed


def test_every_stored_result_is_printed(pages):
    text = "".join((ROOT / "docs" / "templates" / f"{name}.md.j2").read_text() for name in pages.PAGES)
    for file in pages.RESULTS.glob("*.tsv"):
        head, *rows = pages.read_rows(file)
        calls = (
            [f"{file.stem}('{row[0]}'" for row in rows]
            if head == pages.COLUMNS
            else [f"table('{file.stem}')"]
        )
        assert not [call for call in calls if call not in text], file.name
        assert file.read_text().startswith("# made by: "), file.name


PRINTED_VALUE = re.compile(r"(\w+)\('([^']+)'(?:, (\d+))?")


def test_a_stored_value_has_the_same_digits_on_every_page(pages):
    """README and pages once printed one number as 2.001, 2.2 and 2.0."""
    digits = {}
    for name in pages.PAGES:
        for stem, quantity, decimals in PRINTED_VALUE.findall(
            (ROOT / "docs" / "templates" / f"{name}.md.j2").read_text()
        ):
            digits.setdefault((stem, quantity), set()).add(decimals)
    assert len(digits) >= 150
    assert not {value: ways for value, ways in digits.items() if len(ways) > 1}
    assert digits["study", "patient1 physical q_max"] == {"1"}, "not as stored"


def test_a_number_changed_by_hand_is_detected(pages, tmp_path, monkeypatch):
    page = tmp_path / "study.md"
    text = pages.PAGES["study"].read_text()
    (row,) = re.findall(r"^\| ours, `locking` \|.*$", text, re.MULTILINE)
    other = re.sub(r"(\d) \|", lambda digit: f"{(int(digit[1]) + 1) % 10} |", row, count=1)
    page.write_text(text.replace(row, other))
    monkeypatch.setitem(pages.PAGES, "study", page)
    assert other != row
    assert pages.differences(["study"])[-2:] == [f"-{other}", f"+{row}"]


def test_numbers_of_a_study_are_stored(pages, tmp_path):
    numbers = tmp_path / "numbers.csv"
    numbers.write_text(
        "# made by heartfit\ntable,setting,case,quantity,value\ntable1,locking,mean of 7,V_min,1.23456\n"
        "table1,locking,volunteer1,failed points,0 of 9\n"
    )
    rows = [
        ["V_min", "9", "%", "table1/locking/mean of 7/V_min", "old"],
        ["q_max", "8", "%", "table1/locking/mean of 7/q_max", "old"],
        ["duration", "29", "min", "", "old"],
    ]
    assert pages.renewed(rows, numbers, "new") == [
        ["V_min", "1.235", "%", "table1/locking/mean of 7/V_min", "new"],
        *rows[1:],
    ]


def test_printed_tables_of_a_study_are_stored_with_each_quote_once(pages, tmp_path):
    claims = tmp_path / "claims.csv"
    stated = "4.3,about 25%,error of q_max,about 25,%"
    claims.write_text(
        "# made by heartfit\nplace,quote,quantity,paper,unit,setting,ours\n"
        f"{stated},locking,1.50\n{stated},physical,nan\n"
    )
    assert pages.printed(claims) == [
        ["place", "quote", "quantity", "paper", "unit", "setting", "ours"],
        ["4.3", "about 25%", "error of q_max", "about 25", "%", "locking", "1.50"],
        ["", "", "", "", "", "physical", "nan"],
    ]


def test_findings_are_stored_with_the_cases_as_columns(pages, tmp_path):
    findings = tmp_path / "discovery.csv"
    findings.write_text(
        "# made by heartfit\ncase,setting,quantity,text,value\nhidden1,physical,hidden,a leak,\n"
        "hidden1,physical,size,0.32,0.32\nsound1,physical,hidden,nothing,\n"
    )
    assert pages.printed(findings) == [
        ["finding", "hidden1, physical", "sound1, physical"],
        ["hidden", "a leak", "nothing"],
        ["size", "0.32", ""],
    ]


def test_a_quantity_that_is_not_stored_is_named(pages):
    values = pages.Values(Path("study.tsv"), {"V_min": "1.25"})
    assert (values("V_min", 1), values("V_min", 2, plus=True), values("V_min")) == ("1.2", "+1.25", "1.25")
    with pytest.raises(KeyError, match=r"study\.tsv has no 'q_max'"):
        values("q_max")
