"""The suffix selects the format of a table; published tables are read without their origin lines."""

import re
from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

from heartfit.core.errors import InputError
from heartfit.io.figures import write_figure, write_figures
from heartfit.io.tables import (
    read_claims,
    read_numbers,
    read_published,
    read_shape,
    write_csv,
    write_measured_tables,
    write_table,
    write_tables,
)
from heartfit.results.text import NOTES, printed_tables, render_table, render_tables

TABLE = pd.DataFrame({"setting": ["locking"], "case": ["a_b"], "sigma_0 (kPa)": [240.0]})


@pytest.mark.parametrize(
    ("suffix", "content"),
    [("csv", "locking,a_b,240"), ("md", "| locking "), ("tex", r"$\sigma_{0}$ (kPa) \\")],
)
def test_the_suffix_decides(tmp_path: Path, suffix: str, content: str) -> None:
    write_table(tmp_path / f"table.{suffix}", render_table(TABLE))
    assert content in (tmp_path / f"table.{suffix}").read_text()


@pytest.mark.parametrize(("suffix", "line"), [("csv", 0), ("md", -1), ("tex", 0)])
def test_every_table_states_its_origin(tmp_path: Path, suffix: str, line: int) -> None:
    write_table(tmp_path / f"table.{suffix}", render_table(TABLE))
    header = (tmp_path / f"table.{suffix}").read_text().splitlines()[line]
    assert re.match(r"(# |<!-- |% )made by heartfit \S+, Python \d.*, code [0-9a-f]{16}", header)


def test_a_csv_is_read_without_its_line_of_origin(tmp_path: Path) -> None:
    write_csv(tmp_path / "numbers.csv", TABLE)
    for read in (read_numbers, read_published, read_shape):
        assert read(tmp_path / "numbers.csv").columns.tolist() == TABLE.columns.tolist()


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.xlsx"):
        write_table(tmp_path / "table.xlsx", render_table(TABLE))


def test_the_published_means_recompute_to_their_rounding() -> None:
    folder = Path(__file__).parents[2] / "resources" / "marchesseau2012"
    for name, tolerance in (("table1.csv", 0.01), ("table2.csv", 0.06)):
        table = read_published(folder / name)
        volunteers = table[[str(number) for number in range(1, 8)]]
        assert volunteers.mean(axis=1).tolist() == pytest.approx(table["mean"].tolist(), abs=tolerance)


@pytest.mark.parametrize("suffix", ["png", "pdf"])
def test_a_figure_is_the_same_file_every_time(tmp_path: Path, suffix: str) -> None:
    for name in ("a", "b"):
        figure = Figure()
        figure.subplots().plot([0, 1])
        write_figure(tmp_path / f"{name}.{suffix}", figure)
    content = (tmp_path / f"a.{suffix}").read_bytes()
    assert content == (tmp_path / f"b.{suffix}").read_bytes()
    assert b"CreationDate" not in content
    assert b"Software" not in content


def test_tables_and_figures_are_written_by_name_with_their_note(tmp_path: Path) -> None:
    write_tables(tmp_path, render_tables({"table1": TABLE, "other": TABLE}))
    write_figures([f"{tmp_path}/card.{end}" for end in ("png", "pdf")], {"card": Figure(), "other": Figure()})
    suffixes = [("table1", ("csv", "md", "tex")), ("other", ("csv", "md", "tex")), ("card", ("png", "pdf"))]
    assert {file.name for file in tmp_path.iterdir()} == {
        f"{name}.{end}" for name, ends in suffixes for end in ends
    }
    assert f"|\n\n{NOTES['table1']}\n\n<!-- made by" in (tmp_path / "table1.md").read_text()
    assert "|\n\n<!-- made by" in (tmp_path / "other.md").read_text()
    assert "Why" not in (tmp_path / "table1.csv").read_text()


def test_numbers_are_text_and_claims_are_numbers(tmp_path: Path) -> None:
    (tmp_path / "numbers.csv").write_text("table,value\ntable1,<4\ntable1,1.50\n")
    assert read_numbers(tmp_path / "numbers.csv")["value"].tolist() == ["<4", "1.50"]
    (tmp_path / "claims.tsv").write_text("# of the study\ncase\texpected\nmean of 7\t1.5\n")
    assert read_claims(tmp_path / "claims.tsv")["expected"].tolist() == [1.5]
    for read in (read_numbers, read_claims):
        with pytest.raises(InputError, match="no such file"):
            read(tmp_path / "none")


def test_a_stored_result_states_its_command_and_holds_the_cells_as_printed(tmp_path: Path) -> None:
    path = tmp_path / "planted_rates.tsv"
    tables = printed_tables({"rates": TABLE.assign(share=0.123456), "other": TABLE})
    write_measured_tables([str(path)], "planted", tables, "snakemake discovery_benchmark")
    first, head, row = path.read_text().splitlines()
    assert re.fullmatch(r"# made by: snakemake discovery_benchmark; commit: (\w{7,}|unknown)", first)
    assert head.split("\t") == ["setting", "case", "sigma_0 (kPa)", "share"]
    assert row.split("\t") == ["locking", "a_b", "240.0", "0.12"]
