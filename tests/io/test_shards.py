"""Shards are studies of the same kind, and their numbers are put together again."""

import pandas as pd
import pytest
import yaml

from heartfit.cli import main
from heartfit.errors import InputError
from heartfit.io.shards import read_joined, write_shards
from heartfit.tables.joined import summary

CASES = "case\tkind\tperiod_s\n" + "".join(f"heart{n}\tmeasured\t0.8\n" for n in range(5))
COLUMNS = ["table", "setting", "case", "quantity", "value", "unit", "fingerprint"]


def numbers(folder, **values):
    rows = [("table1", "paper", case, "V_min", value, "%", "abc") for case, value in values.items()]
    (folder / "tables").mkdir(parents=True)
    table = pd.DataFrame(rows, columns=COLUMNS)
    (folder / "tables" / "numbers.csv").write_text("# made by a test\n" + table.to_csv(index=False))
    return folder


def test_a_shard_is_a_table_of_cases_and_a_configuration_over_the_study(tmp_path):
    (tmp_path / "cases.tsv").write_text(CASES)
    over = {"sources": {"heart2": {"fit": "a"}, "heart0": {"fit": "b"}}, "unscented": {"noise": True}}
    first, second = write_shards(tmp_path / "shards", tmp_path / "cases.tsv", "heart3", 2, "results", over)
    assert yaml.safe_load(second.read_text()) == {
        "cases": (tmp_path / "shards" / "001.tsv").as_posix(),
        "results": "results/shards/001",
        "sources": {"heart2": {"fit": "a"}},
        "unscented": {"noise": True},
    }
    rows = first.with_suffix(".tsv").read_text().splitlines()
    assert [row.split("\t")[0] for row in rows] == ["case", "heart3", "heart0", "heart1"]


def test_a_reference_that_is_no_case_is_refused(tmp_path):
    (tmp_path / "cases.tsv").write_text(CASES)
    with pytest.raises(InputError, match="expected heart9 for every shard"):
        write_shards(tmp_path / "shards", tmp_path / "cases.tsv", "heart9", 2, "results", {})


def test_numbers_of_shards_are_joined_the_reference_once(tmp_path):
    shards = [
        numbers(tmp_path / "0", heart3="5.5", heart0="4.0"),
        numbers(tmp_path / "1", heart3="5.5", heart1="2"),
    ]
    found = read_joined(shards)
    assert dict(zip(found["case"], found["value"], strict=True)) == {
        "heart3": "5.5",
        "heart0": "4.0",
        "heart1": "2",
    }
    row = summary(found).iloc[0]
    assert (row["cases"], row["least"], row["largest"]) == (3, 2.0, 5.5)
    assert row["mean"] == pytest.approx(11.5 / 3)


def test_shards_that_disagree_on_the_reference_are_refused(tmp_path):
    shards = [numbers(tmp_path / "0", heart3="5.5"), numbers(tmp_path / "1", heart3="5.6")]
    with pytest.raises(InputError, match=r"1: V_min of heart3 is 5\.6, in .*0 5\.5; expected the same"):
        read_joined(shards)


def test_the_command_writes_the_joined_tables(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shards = [numbers(tmp_path / "0", heart3="5.5"), numbers(tmp_path / "1", heart1="2")]
    assert main(["join", *map(str, shards), "-o", "joined"]) == 0
    assert capsys.readouterr().out == "2 cases of 2 shards in joined\n"
    assert sorted(file.name for file in (tmp_path / "joined").glob("summary.*")) == [
        "summary.csv",
        "summary.md",
        "summary.tex",
    ]
