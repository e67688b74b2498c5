"""Malformed input ends in one clear line and exit code 2: never a traceback, a hang, a result, or no complaint."""

from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

from tests.malformed import (
    case_tables,
    configurations,
    hearts,
    images,
    meshes,
    own_walls,
    pressures,
    recordings,
)
from tests.malformed.case import Malformed, exit_code, files_in

LISTS = (configurations, case_tables, hearts, images, pressures, own_walls, recordings, meshes)
MALFORMED = [entry for module in LISTS for entry in module.MALFORMED]
STRIDE = 6
"""One of so many is tried by default, all of them by `python3 study.py malformed`."""

LONGEST = 600
"""Largest length of a readable line [characters]."""


def parametrised_entries() -> list[ParameterSet]:
    long = pytest.mark.long
    return [
        pytest.param(entry, id=entry.name, marks=[long] if number % STRIDE else [])
        for number, entry in enumerate(MALFORMED)
    ]


@pytest.mark.parametrize("source", ["", "|imaged.yaml", "|own.yaml"])
def test_sound_input_is_read(source: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_code(f"check|--no-picture|--config|sound.yaml{source}") == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("entry", parametrised_entries())
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


def test_names_of_malformed_inputs_are_unique_and_many() -> None:
    names = [entry.name for entry in MALFORMED]
    assert len(names) == len(set(names)) >= 150
