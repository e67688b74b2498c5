"""The reference page of the command line is what the parsers of the commands say."""

import argparse
import re

import pytest

from heartfit.cli.main import command_parser
from tests.sources import script


@pytest.fixture(scope="module")
def reference():
    return script("docs/command_line.py")


def test_the_page_is_that_of_the_parsers(reference):
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page(), "python docs/command_line.py"


def test_every_option_of_the_help_is_on_the_page(reference, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "1000")  # no option is broken at a hyphen
    with pytest.raises(SystemExit):
        command_parser().parse_args(["diagnose", "--help"])
    options = set(re.findall(r"--[\w-]+", capsys.readouterr().out)) - {"--help"}
    section = reference.page().partition("## heartfit diagnose MEASURED")[2].partition("\n## ")[0]
    assert len(options) > 10
    assert options <= set(re.findall(r"--[\w-]+", section))


def test_an_option_is_shown_with_its_values(reference):
    parser = argparse.ArgumentParser()
    several = parser.add_argument("--set", nargs="+", metavar="NAME=VALUE")
    chosen = parser.add_argument("-k", "--kind", choices=["measured", "virtual"])
    flag = parser.add_argument("--renew", action="store_true")
    shown = [reference._name(action) for action in (several, chosen, flag)]
    assert shown == ["--set NAME=VALUE ...", "-k, --kind measured|virtual", "--renew"]
