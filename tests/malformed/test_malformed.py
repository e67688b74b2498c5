"""Malformed input ends in one clear line and exit code 2: never a traceback, a hang, a result, or no complaint."""

from pathlib import Path

import pytest

from tests.malformed import hearts, texts
from tests.malformed.case import Malformed, exit_code, files_in

MALFORMED = [*texts.MALFORMED, *hearts.MALFORMED]
LONGEST = 600
"""Largest length of a readable line [characters]."""


@pytest.mark.parametrize("source", ["", "|imaged.yaml", "|own.yaml"])
def test_sound_input_is_read(source: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_code(f"check|--no-picture|--config|sound.yaml{source}") == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("entry", MALFORMED, ids=lambda entry: entry.name)
def test_malformed_input_is_refused_in_one_clear_line(
    entry: Malformed, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    entry.lay(here)
    before = files_in(here)
    assert exit_code(entry.command) == 2
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    assert all(line.startswith("heartfit: ") and len(line) < LONGEST for line in lines)
    assert entry.refused_by(lines)
    assert not printed.out
    assert files_in(here) == before
