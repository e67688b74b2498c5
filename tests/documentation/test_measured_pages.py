"""Pages print the stored results, which are the reference results of the study; each is printed."""

import re
from itertools import pairwise
from pathlib import Path

import pytest

from heartfit.io.tables import read_published
from tests.sources import script

ROOT = Path(__file__).parents[2]
WHICH_DATA = ROOT / "docs" / "which_data.md"


@pytest.fixture(scope="module")
def pages():
    return script("docs/measured_pages.py")


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


def test_every_stored_result_is_printed_or_linked(pages):
    templates = [pages.ROOT / "docs" / "templates" / f"{name}.md.j2" for name in pages.TEMPLATES]
    texts = [*templates, *(ROOT / "docs").glob("*.md"), *(ROOT / "studies").rglob("*.md")]
    text = "".join(path.read_text() for path in texts)
    for file in pages.RESULTS.glob("*.tsv"):
        head, *rows = pages.read_rows(file)
        values = [f"{file.stem}('{row[0]}'" for row in rows] if head == pages.COLUMNS else []
        shown = [f"measured/{file.name})", f"table('{file.stem}')", f"<!-- table: {file.stem} -->"]
        assert any(call in text for call in shown) or (values and all(call in text for call in values)), (
            file.name
        )
        assert file.read_text().startswith("# made by: "), file.name


LINK = re.compile(r"\[(\d+) [^\]]*\]\([./]*docs/measured/(\w+)\.tsv\)")


def test_a_link_that_begins_with_a_number_leads_to_so_many_rows(pages):
    links = [link for page in (ROOT / "studies").rglob("*.md") for link in LINK.findall(page.read_text())]
    assert len(links) >= 3
    for number, stem in links:
        assert len(pages.read_rows(pages.RESULTS / f"{stem}.tsv")) - 1 == int(number), stem


PRINTED_VALUE = re.compile(r"(\w+)\('([^']+)'(?:, (\d+))?")


def test_a_stored_value_has_the_same_digits_on_every_page(pages):
    """README and pages once printed one number as 2.001, 2.2 and 2.0."""
    templates = [(ROOT / "docs" / "templates" / f"{name}.md.j2").read_text() for name in pages.TEMPLATES]
    values = [
        value
        for page in (ROOT / "docs").glob("*.md")
        for _, value, _ in pages.VALUE.findall(page.read_text())
    ]
    digits = {}
    for text in (*templates, *values):
        for stem, quantity, decimals in PRINTED_VALUE.findall(text):
            digits.setdefault((stem, quantity), set()).add(decimals)
    assert len(digits) >= 80
    assert not {value: ways for value, ways in digits.items() if len(ways) > 1}
    assert digits["study", "patient1 physical q_max"] == {"1"}, "not as stored"


def test_a_number_changed_by_hand_is_detected(pages, tmp_path):
    page = tmp_path / "study.md"
    text = pages.TEMPLATES["study"].read_text()
    (row,) = re.findall(r"^\| ours, `locking` \|.*$", text, re.MULTILINE)
    other = re.sub(r"(\d) \|", lambda digit: f"{(int(digit[1]) + 1) % 10} |", row, count=1)
    page.write_text(text.replace(row, other))
    assert other != row
    assert pages.differences({page: text})[-2:] == [f"-{other}", f"+{row}"]


def test_tables_of_a_page_are_filled_and_rows_selected(pages, tmp_path, monkeypatch):
    table = pages.Table(tmp_path / "speeds.tsv", [["who", "v"], ["one", "1"], ["two", "2"], ["three", "3"]])
    monkeypatch.setattr(pages, "stored", lambda: {"speeds": table})
    old = "A\n\n<!-- table: speeds; who = one or three -->\n| old |\n<!-- end -->\nB\n"
    filled = pages.fill(old)
    assert filled.splitlines()[3:-1] == [
        "",
        "| who | v |",
        "|---|---|",
        "| one | 1 |",
        "| three | 3 |",
        "",
        "<!-- end -->",
    ]
    assert pages.fill(filled) == filled
    with pytest.raises(KeyError, match="no rows of 'who' for all of four"):
        pages.fill("<!-- table: speeds; who = four -->\n<!-- end -->\n")
    assert (table.cell("two", "v"), table.count("v", "2")) == ("2", "1 of 3")
    with pytest.raises(KeyError, match="0 rows that begin with"):
        table.cell("four", "v")


def test_a_value_within_a_line_is_filled_and_one_that_is_not_stored_is_an_error(pages):
    text = "Of <!-- value: study('coverage spheres', 0) -->9<!-- end --> % and <!-- value: 1 + 1 --><!-- end -->."
    filled = pages.fill(text)
    assert filled == text.replace(">9<", ">95<").replace("1 --><", "1 -->2<")
    assert pages.fill(filled) == filled
    with pytest.raises(KeyError, match="has no 'coverage of nothing'"):
        pages.fill("<!-- value: study('coverage of nothing', 0) --><!-- end -->")


def test_a_count_has_its_exact_interval(pages):
    assert pages.exact("0 of 40") == "0 % (0 to 9)"
    assert pages.exact("13 of 14") == "93 % (66 to 100)"


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


def test_the_pages_state_the_detection_limits_of_the_stored_table(pages):
    least: dict[str, float] = {}
    for effect, _, scales, *_ in pages.read_rows(pages.RESULTS / "detection_limits.tsv")[1:]:
        name, size = effect.split()[0], float("inf") if scales == "> 4" else float(scales)
        least[name] = min(least.get(name, size), size)
    never = sum(size == float("inf") for size in least.values())
    late = sum(2.0 < size <= 4.0 for size in least.values())
    text = " ".join((ROOT / "docs" / "limits.md").read_text().split())
    assert (
        f"Of the {len(least)} effects of the library {never} are not expected to show even at 4 scales"
        in text
    )
    assert f"{late} more only above 2" in text
    (table,) = re.findall(
        r"\| detected at \| effects \|\n\|---\|---\|\n((?:\|.*\n)+)", WHICH_DATA.read_text()
    )
    bounds = (0.0, 1.0, 2.0, 4.0, float("inf"))
    counted = [row.count(",") + 1 for row in table.splitlines()]
    assert counted == [sum(low < size <= high for size in least.values()) for low, high in pairwise(bounds)]
