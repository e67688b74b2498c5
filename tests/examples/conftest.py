"""Examples run in a folder of their own."""

import runpy

import pytest

from heartfit.discovery.sphere_model import searched_recording
from heartfit.discovery.sphere_model.forward_model import candidates
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


TRIED = ("CatheterDelay", "ImageShrinkage", "MitralRegurgitation")


@pytest.fixture
def three_mechanisms(monkeypatch):
    """A search of three mechanisms; all are tried where the pages run the command."""
    monkeypatch.setattr(
        searched_recording,
        "candidates",
        lambda model: {name: one for name, one in candidates(model).items() if name in TRIED},
    )
