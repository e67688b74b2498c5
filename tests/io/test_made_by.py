"""Versions and state of the code that made a result."""

import platform

import numpy as np
import pytest

from heartfit.cli import main as cli
from heartfit.io import fingerprint as module
from heartfit.io.fingerprint import made_by, versions
from heartfit.io.results import write_result


@pytest.fixture(autouse=True)
def cleared_caches():
    """Caches are cleared between tests."""
    made_by.cache_clear()
    versions.cache_clear()
    yield
    made_by.cache_clear()
    versions.cache_clear()


def test_python_and_packages_are_named_with_their_versions():
    assert f"Python {platform.python_version()}, numpy {np.__version__}, scipy " in versions()
    assert "not installed" not in versions().replace("heartfit not installed", "")


def test_an_edit_changes_the_fingerprint_of_the_code(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "PACKAGE", tmp_path)
    (tmp_path / "law.py").write_text("slope = 1\n")
    before = made_by()
    made_by.cache_clear()
    (tmp_path / "law.py").write_text("slope = 2\n")
    after = made_by()
    assert before != after
    assert before.rsplit(" ", 1)[0] == after.rsplit(" ", 1)[0]


def test_the_command_line_prints_the_origin_of_a_result(capsys):
    with pytest.raises(SystemExit, match="0"):
        cli.main(["--version"])
    assert " ".join(capsys.readouterr().out.split()) == made_by()


def test_a_result_states_its_origin(tmp_path):
    write_result(tmp_path / "r.json", {}, "abc")
    assert f'"made_by": "{versions()}"' in (tmp_path / "r.json").read_text()
