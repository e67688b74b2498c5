"""The blocks of the README run as they stand, the search with a coarse schedule and three mechanisms."""

import re
import shlex

import pytest

from heartfit.cli import main as cli
from tests.examples.pages import EXAMPLES
from tests.sources import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
RUN_HERE = re.compile(r"<!-- run by tests/examples/test_readme.py -->\n```(\w*)\n(.*?)```", re.DOTALL)
BLOCKS = {language or "console": code for language, code in RUN_HERE.findall(README)}


pytestmark = pytest.mark.usefixtures("coarse_search", "three_mechanisms")


@pytest.fixture(autouse=True)
def _in_a_folder_with_the_examples(monkeypatch, tmp_path):
    (tmp_path / "examples").symlink_to(EXAMPLES)
    monkeypatch.chdir(tmp_path)


def test_the_readme_has_a_command_and_eight_lines_of_python():
    assert set(BLOCKS) == {"console", "python"}
    assert len([line for line in BLOCKS["python"].splitlines() if line]) <= 8


def test_the_command_prints_the_name_and_writes_the_card(tmp_path, capsys):
    program, *arguments = shlex.split(BLOCKS["console"])
    assert program == ".venv/bin/heartfit"
    assert cli.main(arguments) == 0
    printed = re.match(r"Missing mechanism: mitral regurgitation, (0\.\d+) cm²", capsys.readouterr().out)
    assert 0.5 < float(printed[1]) < 0.7, "planted is 0.6 cm²"
    assert list(tmp_path.rglob("cause.png"))


def test_the_lines_of_python_name_the_leak(capsys):
    exec(compile(BLOCKS["python"], "README.md", "exec"), {})
    volume, named = capsys.readouterr().out.splitlines()
    assert 3e-5 < float(volume.split()[0]) < 5e-5
    assert named.startswith("named (")
    assert "MitralRegurgitation" in named
