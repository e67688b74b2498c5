"""Full and read-only disks: a small disk in memory in place of the results."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.faults.outcome import Outcome, half_written, last_words, one_more_call
from tests.faults.tiny import TinyStudy

ROOM = 100_000  # free bytes on a disk that will be full
NEEDS_ROOT = "not tried: needs root, to mount a disk in memory"


def full_disk(study: TinyStudy, expected: dict[str, str]) -> list[Outcome]:
    """Room for some jobs only, then enough room."""
    fault = f"the disk of the results full after {ROOM / 1e6:g} MB more, then enlarged"
    if os.geteuid():
        return [Outcome(fault, NEEDS_ROOT, True)]
    with _small_disk(study) as disk:
        study.remove("volunteer1/physical", "tables", "figures")
        _remount(disk, f"size={_used(disk) + ROOM}")
        code, output = study.run()
        spoilt = half_written(study, expected)
        _remount(disk, "size=1g")
        mended = one_more_call(study, expected) and code != 0 and not spoilt
    words = last_words(output, "No space left on device")
    return [Outcome(fault, f"the call ended with {code}: “{words}”; {len(spoilt)} incomplete files", mended)]


def read_only(study: TinyStudy, expected: dict[str, str]) -> list[Outcome]:
    """Results on a disk that is mounted for reading."""
    fault = "the folder of results mounted read-only, then writable"
    if os.geteuid():
        return [Outcome(fault, NEEDS_ROOT, True)]
    with _small_disk(study) as disk:
        study.remove("volunteer1/physical", "tables", "figures")
        _remount(disk, "ro")
        code, output = study.run()
        _remount(disk, "rw")
        mended = one_more_call(study, expected) and code != 0
    words = last_words(output, "cannot be written")
    return [Outcome(fault, f"the call ended with {code}: “{words}”", mended)]


@contextmanager
def _small_disk(study: TinyStudy) -> Iterator[Path]:
    """The kept results on a disk of their own."""
    study.put_back()
    results = study.folder / "results"
    aside = results.with_name("aside")
    results.rename(aside)
    results.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1g", "tmpfs", results], check=True)
    try:
        shutil.copytree(aside, results, dirs_exist_ok=True)
        yield results
    finally:
        subprocess.run(["umount", results], check=True)
        shutil.rmtree(aside)


def _remount(disk: Path, options: str) -> None:
    subprocess.run(["mount", "-o", f"remount,{options}", disk], check=True)


def _used(disk: Path) -> int:
    space = os.statvfs(disk)
    return (space.f_blocks - space.f_bfree) * space.f_frsize
