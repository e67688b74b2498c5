"""Start of a run: after a killed run, beside a running one, and in a folder without write permission."""

import os
import pickle
import sys
import time
from contextlib import closing

import pytest

from heartfit.core.errors import InputError
from heartfit.io.files import keep_sums, write_text
from heartfit.io.run import Run
from tests.printed import numbers_in

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="its files cannot be locked so")


@pytest.fixture
def results(tmp_path):
    keep_sums(tmp_path / "results")
    return tmp_path / "results"


@pytest.fixture
def state(tmp_path):
    (tmp_path / ".snakemake" / "locks").mkdir(parents=True)
    return tmp_path / ".snakemake"


def put_in_order(results, state):
    """Lines that a run reports when it starts."""
    with closing(Run(results, state)) as run:
        return run.put_in_order()


def test_a_run_in_order_reports_no_line(results, state):
    write_text(results / "beat.json", "{}")
    assert put_in_order(results, state) == []
    assert (results / "beat.json").read_text() == "{}"


def test_the_lock_of_a_killed_run_is_taken_away(results, state):
    (state / "locks" / "0.input.lock").touch()
    assert len(put_in_order(results, state)) == 1
    assert not list((state / "locks").iterdir())


def test_a_concurrent_run_changes_no_file(results, state):
    write_text(results / "beat.json", "{}")
    first = Run(results, state)
    assert first.put_in_order() == []
    (results / "beat.json").write_text("cut")
    (state / "locks" / "0.output.lock").touch()
    second = Run(results, state)
    assert (first.alone, second.alone) == (True, False)
    assert second.put_in_order() == []
    assert (state / "locks" / "0.output.lock").exists()
    first.close()
    second.close()
    assert len(put_in_order(results, state)) == 2


def test_an_altered_file_is_set_aside_once_and_kept(results, state):
    write_text(results / "mine" / "beat.json", "{}")
    (results / "mine" / "beat.json").write_text("by hand")
    (line,) = put_in_order(results, state)
    assert str(results / "mine" / "beat.json") in line
    assert not (results / "mine" / "beat.json").exists()
    assert (results / "mine" / "beat.json.altered").read_text() == "by hand"
    assert put_in_order(results, state) == []


def test_drafts_are_swept_up_and_whole_files_are_not(results, state):
    (results / "mine" / ".draft-a1b2").mkdir(parents=True)
    (results / "mine" / ".draft-a1b2" / "beat.json").write_text("ha")
    (results / "mine" / "beat.csv").touch()
    (results / ".sums" / ".draft-beat.json").touch()
    assert put_in_order(results, state) == []
    assert [file.name for file in (results / "mine").iterdir()] == ["beat.csv"]
    assert not list((results / ".sums").iterdir())


def test_kernels_that_are_cut_off_are_dropped_and_whole_ones_kept(results, state, tmp_path):
    whole = pickle.dumps("0.60") + pickle.dumps(({"one": 1}, b"code" * 100))
    for name, content in {"a.nbi": whole, "b.nbc": whole[:-1], "c.nbc": whole[:30], "d.nbi": b""}.items():
        (tmp_path / name).write_bytes(content)
    with closing(Run(results, state, kernels=tmp_path)) as run:
        (line,) = run.put_in_order()
    assert numbers_in(line)[0] == 3.0
    assert [file.name for file in tmp_path.glob("*.nb*")] == ["a.nbi"]


def test_a_file_from_the_future_is_dated_now_and_an_old_one_keeps_its_date(results, state):
    for name, hours in (("ahead", 1), ("old", -1)):
        write_text(results / name, name)
        os.utime(results / name, (time.time() + 3600 * hours,) * 2)
    (line,) = put_in_order(results, state)
    assert numbers_in(line)[0] == 1.0
    assert str(results / "ahead") in line
    assert (results / "ahead").stat().st_mtime <= time.time()
    assert (results / "old").stat().st_mtime < time.time() - 3000


def test_an_unwritable_folder_is_reported_in_one_line(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="File exists"):
        Run(tmp_path / "results", tmp_path / "file")
    (tmp_path / "results").mkdir()
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(InputError, match=str(tmp_path / "results")):
        Run(tmp_path / "results", tmp_path / ".snakemake")
