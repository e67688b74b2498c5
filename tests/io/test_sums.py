"""Check sums of written files, and files that are complete or absent."""

import errno
import hashlib
import subprocess
import sys

import pytest

from heartfit.io.files import altered, forget, is_as_written, keep_sums, replacing, write_text
from heartfit.io.run import record


@pytest.fixture
def results(tmp_path):
    keep_sums(tmp_path / "results")
    return tmp_path / "results"


def test_a_file_written_elsewhere_leaves_no_other_file(tmp_path):
    write_text(tmp_path / "folder" / "beat.json", "{}\n")
    assert [file.name for file in tmp_path.rglob("*")] == ["folder", "beat.json"]
    assert is_as_written(tmp_path / "folder" / "beat.json")


def test_the_sum_is_that_of_sha256sum(results):
    write_text(results / "mine" / "beat.json", "{}\n")
    noted = (results / ".sums" / "mine" / "beat.json").read_text()
    assert noted == f"{hashlib.sha256(b'{}' + bytes([10])).hexdigest()}  beat.json\n"
    assert not altered(results)


@pytest.mark.parametrize("spoil", [b"", b"time_s\n0\n", b"time_s\n0\n2\n", b"time_s\n0\n1\n2\n"])
def test_a_truncated_changed_or_longer_file_is_detected(results, spoil):
    file = results / "curves.csv"
    write_text(file, "time_s\n0\n1\n")
    write_text(results / "whole.csv", "time_s\n0\n1\n")
    file.write_bytes(spoil)
    assert altered(results) == [file]
    assert not is_as_written(file)
    forget(file)
    assert not altered(results)


def test_a_deleted_or_rewritten_file_does_not_count_as_altered(results):
    for name in ("gone", "again"):
        write_text(results / name, "one")
    (results / "gone").unlink()
    write_text(results / "again", "two")
    assert not altered(results)


def test_a_draft_within_a_draft_is_not_noted(results):
    with replacing(results / "cine.nrrd") as draft:
        write_text(draft, "voxels")
    assert [file.name for file in (results / ".sums").rglob("*")] == ["cine.nrrd"]
    assert [file.name for file in results.iterdir() if file.name != ".sums"] == ["cine.nrrd"]


def test_a_block_that_ends_badly_leaves_the_file_as_it_was(results):
    write_text(results / "beat.json", "whole")
    with pytest.raises(FileNotFoundError), replacing(results / "beat.json") as draft:
        draft.with_name("another").rename(draft)
    assert (results / "beat.json").read_text() == "whole"
    assert not altered(results)


def test_a_full_disk_is_one_line_in_the_log(tmp_path):
    failing = (
        f"from heartfit.io.run import record; record({str(tmp_path / 'job.log')!r})\n"
        f"raise OSError({errno.ENOSPC}, 'No space left on device', 'results/beat.json')"
    )
    assert record.__module__ in failing
    assert subprocess.run([sys.executable, "-c", failing], check=False).returncode == 1
    log = (tmp_path / "job.log").read_text()
    assert log == "results/beat.json: No space left on device; make room and run again\n"
