"""Shards are studies of the same kind; their numbers are merged."""

import pandas as pd
import pytest
import yaml

from heartfit.cli.main import main
from heartfit.core.errors import InputError
from heartfit.io.campaign import write_shards
from heartfit.io.tables import read_shards
from heartfit.results.provenance import merge_shards, summarise_cohort
from tests.printed import numbers_in

CASES = "case\tkind\tperiod_s\n" + "".join(f"heart{n}\tmeasured\t0.8\n" for n in range(5))
COLUMNS = ["table", "setting", "case", "quantity", "value", "unit", "fingerprint", "seed", "parameters"]


def numbers(folder, **values):
    rows = [
        ("table1", "locking", case, "V_min", value, "%", "abc", "", "mu=1 Pa.s")
        for case, value in values.items()
    ]
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


def test_a_reference_that_is_not_a_case_is_refused(tmp_path):
    (tmp_path / "cases.tsv").write_text(CASES)
    with pytest.raises(InputError, match="expected heart9 for every shard"):
        write_shards(tmp_path / "shards", tmp_path / "cases.tsv", "heart9", 2, "results", {})


def test_numbers_of_shards_are_joined_the_reference_once(tmp_path):
    shards = [
        numbers(tmp_path / "0", heart3="5.5", heart0="4.0"),
        numbers(tmp_path / "1", heart3="5.5", heart1="2"),
    ]
    merged = merge_shards(read_shards(shards))
    assert dict(zip(merged["case"], merged["value"], strict=True)) == {
        "heart3": "5.5",
        "heart0": "4.0",
        "heart1": "2",
    }
    row = summarise_cohort(merged).iloc[0]
    assert (row["cases"], row["least"], row["largest"]) == (3, 2.0, 5.5)
    assert row["mean"] == pytest.approx(11.5 / 3)


def test_ratios_are_to_the_healthy_of_all_shards(tmp_path):
    """A measured heart and a patient over the mean of three volunteers, of which each shard knows two."""

    def shard(name, volunteers, mean, others):
        rows = [
            row
            for case, (estimate, seed) in ({**volunteers, **others}).items()
            for row in (
                ("table2", "locking", case, "mu", estimate, "kPa.s", "abc", seed, "mu=1 Pa.s"),
                ("table2", "locking", case, "mu over mean", estimate / mean, "", "abc", seed, "mu=1 Pa.s"),
            )
        ]
        rows.append(("table2", "locking", "prior", "mu", 12.0, "kPa.s", "abc", "", ""))
        rows.append(("table1", "locking", "mean of 2", "V_min", mean, "%", "abc", "", ""))
        rows.append(
            ("table3_parameters", "locking", "lbbb1", "mu value", 10.0, "kPa.s", "abc", "8", "mu=1 Pa.s")
        )
        rows.append(
            (
                "table3_parameters",
                "locking",
                "lbbb1",
                "mu over healthy mean",
                10.0 / mean,
                "",
                "abc",
                "8",
                "mu=1 Pa.s",
            )
        )
        rows.append(("table2", "the paper's", "volunteer 1", "mu over mean", 0.7, "", "", "", ""))
        folder = tmp_path / name / "tables"
        folder.mkdir(parents=True)
        pd.DataFrame(rows, columns=COLUMNS).to_csv(folder / "numbers.csv", index=False)
        return folder.parent

    shards = [
        shard("0", {"volunteer1": (10.0, "1"), "volunteer2": (20.0, "2")}, 15.0, {"heart1": (40.0, "")}),
        shard("1", {"volunteer1": (10.0, "1"), "volunteer3": (30.0, "3")}, 20.0, {}),
    ]
    merged = merge_shards(read_shards(shards)).set_index(["case", "quantity"])["value"]
    expected = {"volunteer1": 0.5, "volunteer2": 1.0, "volunteer3": 1.5, "heart1": 2.0}
    assert {case: merged[case, "mu over mean"] for case in expected} == expected
    assert merged["lbbb1", "mu over healthy mean"] == 0.5
    assert float(merged["volunteer 1", "mu over mean"]) == 0.7
    assert merged.index.is_unique
    assert not {("mean of 2", "V_min"), ("prior", "mu over mean")} & {*merged.index}


def test_shards_that_disagree_on_the_reference_are_refused(tmp_path):
    shards = [numbers(tmp_path / "0", heart3="5.5"), numbers(tmp_path / "1", heart3="5.6")]
    with pytest.raises(InputError, match=r"1: .*V_min.*heart3.*5\.6.*0.*5\.5"):
        merge_shards(read_shards(shards))


def test_the_command_writes_the_joined_tables(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shards = [numbers(tmp_path / "0", heart3="5.5"), numbers(tmp_path / "1", heart1="2")]
    assert main(["join", *map(str, shards), "-o", "joined"]) == 0
    printed = capsys.readouterr().out
    assert numbers_in(printed) == [2.0, 2.0]
    assert "joined" in printed
    assert sorted(file.name for file in (tmp_path / "joined").glob("summary.*")) == [
        "summary.csv",
        "summary.md",
        "summary.tex",
    ]
