"""Stored tables: what is held, on which machine, and how a deliberate change is stored."""

import json
from pathlib import Path

import pytest
from pandas.testing import assert_frame_equal

from heartfit.cli import main as cli
from heartfit.core.errors import InputError
from heartfit.io.reference import (
    machine,
    read_held_tables,
    read_reference,
    write_ensemble,
    write_reference,
)
from heartfit.results.drift import Drift

TABLE1 = "# made by heartfit\ncase,V_min (%)\nv1,{v1}\n"
CLAIMS = (
    "# made by heartfit\nquantity,paper,unit,ours\ntime of a heart,about 20,min,{minutes}\nerror,11,%,2.1\n"
)
NUMBERS = "# made by heartfit\ntable,value,run,parameters,fingerprint\ntable1,1.5,results/v1,mu=1,{code}\n"


def write(folder: Path, v1: str = "1.25", minutes: str = "0.8", code: str = "abc") -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "table1.csv").write_text(TABLE1.format(v1=v1))
    (folder / "claims.csv").write_text(CLAIMS.format(minutes=minutes))
    (folder / "numbers.csv").write_text(NUMBERS.format(code=code))
    (folder / "costs.csv").write_text(f"stage,seconds\ncalibration,{minutes}\n")
    return folder


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    write_reference(tmp_path / "reference", read_held_tables(write(tmp_path / "tables")))
    return tmp_path / "reference"


def drift(tables: Path, folder: Path) -> Drift:
    return read_reference(folder).compared(read_held_tables(tables), machine())


def test_times_and_fingerprints_are_not_held(tmp_path: Path, stored: Path) -> None:
    tables = write(tmp_path / "again", minutes="3.1", code="other")
    assert set(read_held_tables(tables)) == {"table1", "claims", "numbers"}
    assert drift(tables, stored).moves == []


def test_a_changed_number_drifts(tmp_path: Path, stored: Path) -> None:
    (move,) = drift(write(tmp_path / "again", v1="1.26"), stored).drifted
    assert str(move) == "table1, row 1 (v1), V_min (%): 1.25 before, 1.26 now"


def test_another_machine_may_round_otherwise(tmp_path: Path, stored: Path) -> None:
    stated = json.loads((stored / "machine.json").read_text())
    assert stated == machine()
    (stored / "machine.json").write_text(json.dumps(stated | {"compiled for": "a processor of 2008"}))
    outcome = drift(write(tmp_path / "again", v1="1.2501"), stored)
    assert (len(outcome.moves), outcome.same_machine, outcome.judged) == (1, False, False)


def test_a_folder_without_stored_tables_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no stored tables"):
        drift(write(tmp_path / "tables"), tmp_path / "nothing")
    with pytest.raises(InputError, match="no table; expected"):
        read_held_tables(tmp_path / "nothing")


def test_one_command_prints_what_moved_and_stores_it(tmp_path: Path, stored: Path, capsys) -> None:
    tables = write(tmp_path / "again", v1="1.5")
    assert cli.main(["drift", str(tables), str(stored)]) == 1
    assert "v1), V_min (%): 1.25 before, 1.5 now" in capsys.readouterr().out
    assert cli.main(["drift", str(tables), str(stored), "--renew"]) == 0
    assert "1.25 before, 1.5 now" in capsys.readouterr().out
    assert cli.main(["drift", str(tables), str(stored)]) == 0
    assert cli.main(["drift", str(tmp_path / "empty"), str(stored)]) == 2


def test_what_rounding_moves_is_stored_and_then_allowed(tmp_path: Path, stored: Path) -> None:
    members = [read_held_tables(write(tmp_path / v1, v1=v1)) for v1 in ("1.25", "1.26", "1.24", "1.25")]
    ensemble = write_ensemble(stored, members)
    again = read_reference(stored).ensemble
    assert again is not None
    assert_frame_equal(again.table(), ensemble.table(), rtol=1e-6)
    stated = json.loads((stored / "machine.json").read_text())
    (stored / "machine.json").write_text(json.dumps(stated | {"compiled for": "a processor of 2008"}))
    assert drift(write(tmp_path / "third", v1="1.27"), stored).drifted == []
    assert drift(write(tmp_path / "fourth", v1="2.25"), stored).drifted
