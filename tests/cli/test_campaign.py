"""Commands for many subjects: printed counts and refused arguments."""

import re
from pathlib import Path

import pytest

from heartfit.cli.main import main

ROOT = Path(__file__).parents[2]


def jobs(capsys, *arguments):
    assert main(["plan", *arguments]) == 0
    match = re.search(r"^\| all \| (\d+) \|", capsys.readouterr().out, re.MULTILINE)
    return int(match[1])


def test_a_plan_grows_by_the_same_for_each_subject_setting_and_parameter(capsys):
    both = [jobs(capsys, "--cases", str(number)) for number in (10, 20, 30)]
    assert both[2] - both[1] == both[1] - both[0] > 0
    one = [jobs(capsys, "--cases", str(number), "--setting", "physical") for number in (10, 20)]
    assert one[1] - one[0] < both[1] - both[0]
    counts = [jobs(capsys, "--cases", str(number), "--pressure") for number in (10, 20)]
    assert counts[1] - counts[0] == both[1] - both[0] + 10 * 2 * 6  # three parameters more, two points each


def test_the_page_shows_what_the_command_prints(capsys):
    page = (ROOT / "docs" / "cluster.md").read_text()
    command, shown = re.search(r"^\$ heartfit (plan .*)\n((?:.*\n)*?)```$", page, re.MULTILINE).groups()
    assert main(command.split()) == 0
    assert capsys.readouterr().out == shown


def test_an_unknown_setting_is_refused(capsys):
    assert main(["plan", "--setting", "fisical"]) == 2
    assert "no setting 'fisical'; known are locking, physical" in capsys.readouterr().err


def test_a_plan_without_costs_names_the_command_that_writes_them(capsys, tmp_path):
    assert main(["plan", "--costs", str(tmp_path)]) == 2
    assert "expected measured costs: `heartfit costs` writes them" in capsys.readouterr().err


@pytest.mark.parametrize("size", ["0", "-3", "many"])
def test_shards_of_no_subject_are_refused(capsys, size):
    assert main(["shards", f"--size={size}"]) == 2
    assert f"argument --size: {size}; expected a whole number, one or more" in capsys.readouterr().err
