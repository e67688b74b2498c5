"""Examples run, are short, and say what they promise; the recording is remade."""

import runpy
import shutil

import numpy as np
import pytest

import heartfit as hf
from heartfit.roles import registry
from tests.examples.pages import EXAMPLES, PAGES, assert_shown
from tests.sources import ROOT

SCRIPTS = sorted(EXAMPLES.glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.name)
def test_an_example_has_at_most_thirty_lines(script):
    assert script.read_text().count("\n") <= 30


@pytest.mark.parametrize(("name", "page"), PAGES.items())
def test_a_page_shows_the_example(name, page):
    first = "# oscillator.py\n" if name == "oscillator.py" else ""
    block = f"```python\n{first}{(EXAMPLES / name).read_text()}```\n"
    assert block in (ROOT / "docs" / page).read_text(encoding="utf-8")


def test_every_example_is_run_here():
    assert {script.name for script in SCRIPTS} == {*PAGES, "make_measured.py"}


def test_a_leaking_heart_is_simulated_and_drawn(run, tmp_path):
    assert_shown("simulate.py", run("simulate.py"))
    assert (tmp_path / "loops.png").stat().st_size > 10_000


@pytest.mark.usefixtures("coarse_search", "three_mechanisms")
def test_the_recording_is_diagnosed(run):
    printed = run("diagnose.py")
    assert "verdict: named\nMitralRegurgitation: " in printed
    assert "check first" not in printed


def test_the_leak_is_calibrated(run):
    printed = run("calibrate.py")
    assert_shown("calibrate.py", printed)
    *_, row = (line for line in printed.splitlines() if "MitralRegurgitation.area" in line)
    _, prior, _, low, high, informed = row.split()
    assert float(prior) < float(low) < 6e-5 < float(high)
    assert float(informed) > 0.5


def test_the_drag_of_the_oscillator_is_named(run):
    printed = run("oscillator.py")
    assert "named ('drag',)" in printed
    assert "no scale decides the ranking" in printed


def test_an_own_mechanism_lowers_the_filling(run):
    printed = run("own_mechanism.py")
    assert_shown("own_mechanism.py", printed)
    volumes = [float(line.split()[2]) for line in printed.splitlines()]
    assert volumes == sorted(volumes, reverse=True)
    assert volumes[-1] < volumes[0] - 5.0
    assert "RateLoss" in registry.registered()


def test_the_recording_is_remade(tmp_path):
    shutil.copy(EXAMPLES / "make_measured.py", tmp_path)
    runpy.run_path(str(tmp_path / "make_measured.py"), run_name="__main__")
    stored, remade = (hf.read_recording(folder / "measured.csv") for folder in (EXAMPLES, tmp_path))
    assert stored.curves.keys() == remade.curves.keys() == {"lv_volume", "lv_pressure"}
    for name, samples in stored.curves.items():
        assert np.array_equal(samples.times, remade.curves[name].times)
        assert samples.values == pytest.approx(remade.curves[name].values, rel=1e-6)
