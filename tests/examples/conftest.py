"""Examples run in a folder of their own."""

import runpy

import pytest

from heartfit.roles import registry
from tests.examples.pages import EXAMPLES


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run an example in a folder with the recording; return what it prints."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.setattr(registry, "_REGISTRY", dict(registry.registered()))

    def run_example(name):
        runpy.run_path(str(EXAMPLES / name), run_name="__main__")
        return capsys.readouterr().out

    return run_example
