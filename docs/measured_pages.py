"""Write the pages that print the stored results of docs/measured, or hold them to it.

python docs/measured_pages.py             write the pages
python docs/measured_pages.py --check     write nothing; fail if a page is not what its results give
python docs/measured_pages.py NUMBERS     take the tables of a study first; NUMBERS is its results/tables/numbers.csv

docs/measured/NAME.tsv holds either single values, with the columns of `COLUMNS`, or a table. The first line says what
made it. A page of `TEMPLATES` is written from docs/templates, which prints a value by `NAME('quantity', decimals)`, a
table by `table('NAME')`, one of its cells by `cell('NAME', 'row', 'column')`, the number of its rows with a value in a
column by `count('NAME', 'column', 'value')`, and the exact interval of a count by `exact('9 of 10')`. Any other page of
docs and studies holds its tables, and single values, between comments, and is filled in place:

    <!-- table: NAME -->  or  <!-- table: NAME; column = value or value -->, which selects rows
    <!-- end -->
    <!-- value: NAME('quantity', decimals) --><!-- end -->, within a line and not at its start
"""

import csv
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import unified_diff
from functools import cache
from pathlib import Path

import pandas as pd
from jinja2 import Environment

from heartfit.core.pages import render_page, table_row
from heartfit.io.files import write_text
from heartfit.observation.noise_model import Share
from heartfit.results.text import STATED_ONCE, without_repeats

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs" / "measured"
TEMPLATES = {
    "README": ROOT / "README.md",
    **{name: ROOT / "docs" / f"{name}.md" for name in ("measured_heart", "study", "validation")},
}
"""Templates by name, and what is written from them."""
FILLED = re.compile(r"(<!-- table: (\w+)(?:; ([^=>]+) = ([^>]+))? -->\n).*?(<!-- end -->)", re.DOTALL)
"""Place of a table in a page."""
VALUE = re.compile(r"(<!-- value: ([^>]+) -->).*?(<!-- end -->)", re.DOTALL)
"""Place of a single value in a page, and what a template would print."""
COUNT = re.compile(r"(\d+) of (\d+)")
STUDY = RESULTS / "study.tsv"
FULL = "python3 study.py run --configfile config/full.yaml, with methods: false"
"""Command of the run whose numbers the pages print: all settings, and the stored noise model."""
PRINTED = {
    "study_table1": "table1_as_printed",
    "study_table2": "table2_as_printed",
    "study_claims": "claims",
    "study_discovery": "discovery",
    "study_plausibility": "plausibility",
}
"""Stored tables that a study prints, and their names in its folder of tables."""
NORMAL = "normal"
"""Folder of the results of the second cohort, config/normal.yaml."""
PRINTED_OF_NORMAL = {
    "normal_table1": "table1_as_printed",
    "normal_claims": "claims",
    "normal_patients": "specificity_claims",
}
"""The same for the second cohort."""
OF_VOLUNTEERS = "of the volunteers$|over that after calibration$|^(?:mean|largest) error of [Vq]"
"""Quantities of the claims that the second cohort decides."""
FRACTION = re.compile(r"\d+\.\d+")
"""Numbers that a table stores with all digits and a page prints with two decimals."""
COLUMNS = ["quantity", "value", "unit", "number", "commit"]
"""number: table/setting/case/quantity in the study's numbers.csv, empty where a value is in another result."""
KEY = ("table", "setting", "case", "quantity")
Rows = list[list[str]]


@dataclass(frozen=True)
class Values:
    """Stored values by quantity; called, it prints one. Raises KeyError for a quantity that is not stored."""

    file: Path
    values: dict[str, str]

    def __call__(self, quantity: str, decimals: int | None = None, plus: bool = False) -> str:
        if quantity not in self.values:
            raise KeyError(f"{self.file.name} has no {quantity!r}; add it, or see what a template asks for")
        value = self.values[quantity]
        return value if decimals is None else f"{float(value):{'+' if plus else ''}.{decimals}f}"


@dataclass(frozen=True)
class Table:
    """A stored table, its head first. Raises KeyError for a row or a column that it does not have."""

    file: Path
    rows: Rows

    def where(self, column: str, *values: str) -> Rows:
        """The head and the rows whose cell in a column is one of the values."""
        head, *body = self.rows
        place = self._place(column)
        found = [row for row in body if row[place] in values]
        if len({row[place] for row in found}) < len(values):
            raise KeyError(f"{self.file.name} has no rows of {column!r} for all of {', '.join(values)}")
        return [head, *found]

    def cell(self, *key: str) -> str:
        """The cell of the row that begins with all of the key but its last word, in the column of this name."""
        *start, column = key
        found = [row for row in self.rows[1:] if row[: len(start)] == start]
        if len(found) != 1:
            raise KeyError(f"{self.file.name} has {len(found)} rows that begin with {start}; expected one")
        return found[0][self._place(column)]

    def count(self, column: str, value: str) -> str:
        """How many of the rows have a value in a column."""
        return f"{len(self.where(column, value)) - 1} of {len(self.rows) - 1}"

    def _place(self, column: str) -> int:
        if column not in self.rows[0]:
            raise KeyError(f"{self.file.name} has no column {column!r}; it has {', '.join(self.rows[0])}")
        return self.rows[0].index(column)


def read_rows(file: Path) -> Rows:
    """The rows of a stored result, its head first; without the line that says what made it."""
    return [line.split("\t") for line in file.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]


@cache
def stored() -> dict[str, Table]:
    """The stored results by name."""
    return {file.stem: Table(file, read_rows(file)) for file in sorted(RESULTS.glob("*.tsv"))}


def commit(stem: str) -> str:
    """The version of the sources that made a table."""
    return RESULTS.joinpath(f"{stem}.tsv").read_text(encoding="utf-8").split("commit: ", 1)[1].split()[0]


def exact(counted: str) -> str:
    """A count such as 9 of 10 with its share and the exact 95 % interval of Clopper and Pearson."""
    share = Share.from_count(*map(int, COUNT.match(counted).groups()))
    return f"{100 * share.covered:.0f} % ({100 * share.low:.0f} to {100 * share.high:.0f})"


@cache
def printers() -> dict[str, object]:
    """What templates print the stored results by: functions of tables, and single values by the name of their file."""
    tables = stored()
    values = {
        stem: Values(table.file, {row[0]: row[1] for row in table.rows[1:]})
        for stem, table in tables.items()
        if table.rows[0] == COLUMNS
    }
    return values | {
        "table": lambda stem: markdown(tables[stem].rows),
        "cell": lambda stem, *key: tables[stem].cell(*key),
        "count": lambda stem, column, value: tables[stem].count(column, value),
        "exact": exact,
        "commit": commit,
    }


def render(name: str) -> str:
    """A page from its template and the stored results."""
    return render_page(name, **printers())


def fill(text: str) -> str:
    """A page with the tables and the values that stand between its comments."""

    def filled(found: re.Match[str]) -> str:
        opening, stem, column, values, closing = found.groups()
        table = stored()[stem]
        rows = table.where(column, *values.split(" or ")) if column else table.rows
        return f"{opening}\n{markdown(rows)}\n{closing}"

    def value(found: re.Match[str]) -> str:
        opening, expression, closing = found.groups()
        return f"{opening}{Environment().compile_expression(expression)(**printers())}{closing}"

    return VALUE.sub(value, FILLED.sub(filled, text))


def markdown(rows: Rows) -> str:
    """A table in Markdown."""
    head, *body = rows
    return table_row(*head) + f"|{'---|' * len(head)}\n" + "".join(table_row(*row) for row in body)


def pages() -> dict[Path, str]:
    """What each page should be: those of the templates, and those that hold tables."""
    written = {page: render(name) for name, page in TEMPLATES.items()}
    others = [*ROOT.glob("docs/*.md"), *ROOT.glob("studies/**/*.md")]
    texts = {page: page.read_text(encoding="utf-8") for page in others if page not in written}
    return written | {page: fill(text) for page, text in texts.items() if "<!-- end -->" in text}


def differences(wanted: Mapping[Path, str] | None = None) -> list[str]:
    """Lines in which a page differs from what it should be."""
    return [
        line
        for page, text in (pages() if wanted is None else wanted).items()
        for line in unified_diff(
            page.read_text(encoding="utf-8").splitlines(),
            text.splitlines(),
            page.name,
            "docs/measured",
            lineterm="",
            n=0,
        )
    ]


def renewed(rows: Rows, numbers: Path, commit: str) -> Rows:
    """Stored values with those of a study's numbers.csv; a value whose number the study does not have is kept."""
    with numbers.open(encoding="utf-8") as lines:
        table = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    measured = {"/".join(row[key] for key in KEY): row["value"] for row in table}
    return [
        [quantity, f"{float(measured[number]):.4g}", unit, number, commit]
        if number in measured
        else [quantity, value, unit, number, old]
        for quantity, value, unit, number, old in rows
    ]


def take(numbers: Path) -> None:
    """Write the numbers of a study into the stored results."""
    commit = subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()
    if numbers.parts[-3:-2] == (NORMAL,):
        take_tables(
            numbers, PRINTED_OF_NORMAL, "python3 study.py run --configfile config/normal.yaml", commit
        )
        return
    made_by = STUDY.read_text(encoding="utf-8").splitlines()[0]
    head, *rows = read_rows(STUDY)
    lines = ["\t".join(row) for row in (head, *renewed(rows, numbers, commit))]
    write_text(STUDY, "\n".join([made_by, *lines]) + "\n")
    take_tables(numbers, PRINTED, FULL, commit)


def take_tables(numbers: Path, names: Mapping[str, str], command: str, commit: str) -> None:
    """Write the tables of these names, which stand beside the numbers, into the stored results."""
    for stem, table in names.items():
        lines = ["\t".join(row) for row in printed(numbers.with_name(f"{table}.csv"), stem)]
        made_by = f"# made by: {command} (tables/{table}); commit: {commit}"
        write_text(RESULTS / f"{stem}.tsv", "\n".join([made_by, *lines]) + "\n")


def printed(table: Path, stem: str = "") -> Rows:
    """The rows of a table of text of a study, its head first, as its Markdown shows them."""
    frame = pd.read_csv(table, dtype=str, keep_default_na=False, comment="#")
    if stem == "normal_claims":
        decided = ~frame["verdict"].str.startswith("not comparable")
        frame = frame[decided & frame["quantity"].str.contains(OF_VOLUNTEERS)]
    if stem == "normal_patients":
        frame = frame.map(lambda cell: f"{float(cell):.2f}" if FRACTION.fullmatch(cell) else cell)
    if stem == "study_plausibility":
        frame = of_the_measured_heart(frame)
    if {"case", "setting", "text"} <= {*frame}:
        frame = findings_by_case(frame)
    shown = without_repeats(frame, STATED_ONCE.get(table.stem, ()))
    return [list(shown.columns), *shown.to_numpy().tolist()]


def of_the_measured_heart(frame: pd.DataFrame) -> pd.DataFrame:
    """The numbers of the measured heart under the setting without locking, a row for each, with one decimal."""
    (row,) = frame[(frame["case"] == "patient1") & (frame["setting"] == "physical")].to_dict("records")
    numbers = {name: f"{float(cell):.1f}" for name, cell in row.items() if FRACTION.search(cell)}
    return pd.DataFrame(numbers.items(), columns=["quantity", "calibrated beat"])


def findings_by_case(frame: pd.DataFrame) -> pd.DataFrame:
    """The findings as text, one row for each and one column for each case, as the study prints them."""
    cases = frame["case"] + ", " + frame["setting"]
    order = list(dict.fromkeys(frame["quantity"]))
    wide = frame.assign(case=cases).pivot(index="quantity", columns="case", values="text").reindex(order)
    return wide[list(dict.fromkeys(cases))].fillna("").rename_axis("finding").reset_index()


def main(arguments: list[str]) -> int:
    """Carry out what the module's docstring lists."""
    if arguments == ["--check"]:
        lines = differences()
        advice = "change the template, the page or the stored result, then: python3 study.py numbers"
        sys.stdout.write("\n".join([*lines, advice]) + "\n" if lines else "")
        return int(bool(lines))
    for numbers in arguments:
        take(Path(numbers))
    for page, text in pages().items():
        write_text(page, text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
