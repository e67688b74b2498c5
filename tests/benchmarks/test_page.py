"""The page of performance: verdicts, ratios and exponents of given numbers."""

from itertools import product

import pytest

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.growth import growth
from benchmarks.job import Job
from benchmarks.newton import Newton
from benchmarks.page import ELEMENTS, Measured, exponent, page
from benchmarks.targets import ENGINE, figures

SPHERES = {next(iter(sphere.CASES)): (1e-4, 1e-3), sphere.OURS: (1e-3, 0.0), sphere.THEIRS: (5.0, 0.0)}
SIZES = {"3k": 3000.0, "10k": 10000.0}


@pytest.fixture
def measured():
    beats = {
        (mesh, setting): {
            **dict.fromkeys(("iterations", "factorisations", "unloading_s", "peak_mb"), 400.0),
            **{"tetrahedra": tets, "nodes": tets / 3, "completed": 1.0, "cpu_s": 2e-9 * tets**2.0},
        }
        for (mesh, tets), setting in product(SIZES.items(), ELEMENTS)
    }
    ours = {"residual": 0.01, "tangent and factors": 0.08, "solution": 0.01}
    theirs = {"residual": 0.1, "tangent": 0.5, "factors": 0.8, "solution": 0.1}
    same = {"residual": 0.0, "direction": 0.0}
    steps = [Newton("10k", "mixed", who, 1000, times, same) for who, times in
             (("heartfit", ours), ("NGSolve 6", theirs))]  # fmt: skip
    now = dict.fromkeys(ENGINE, 0.4)
    return Measured(
        beats, [steps], Job(1.0, 1.1, 0.5, 0.08), SPHERES, 5e-3, now, {"beat, 3k": 0.5}, "1234567"
    )


def test_growth_is_the_exponent_of_a_power():
    assert growth([3e3, 1e4, 1e5], [7.0 * n**1.3 for n in (3e3, 1e4, 1e5)]) == pytest.approx(1.3)


def test_figures_carry_the_ratios_and_their_verdicts(measured):
    figure_by_name = {figure.name: figure for figure in figures(measured)}
    assert figure_by_name["Newton step, 10k, `mixed`, beside NGSolve"].measured == pytest.approx(15.0)
    assert figure_by_name["Newton step, 10k, `mixed`, beside NGSolve"].met, "at least 10"
    assert figure_by_name["one job beside its beat"].met
    assert exponent(measured, "physical") == pytest.approx(2.0)
    assert not figure_by_name["growth, `mixed`"].met
    assert not Figure("none", float("nan"), 1.0, "s").met


def test_the_page_shows_every_figure_and_its_verdict(measured):
    text = page(measured, figures(measured))
    assert text.count("**missed**") == 2, "the growth of both elements"
    assert "| 15.0 x | 3000 x |" in text, "1.5 s over 0.1 s, and over an iteration of 0.2 / 400 s"
    assert "| beat of 3k, `mixed` | 0.5 | 0.4 | 0.80 | ≤ 0.5 | CPU s | met |" in text, (
        "beside an earlier version"
    )
    assert "| three beats of 3k |  | 0.4 |  |  | CPU s |  |" in text, (
        "without a target, and not measured before"
    )
    assert "commit `1234567`" in text
    (faster,) = [line for line in text.splitlines() if "| 5e+03 |  | ≥ 1000 |" in line]
    assert faster.endswith("| met |"), "PhysioBlocks over ours"
    assert text.count("| 0.100 | 1.00 |") == 1, "a beat of a sphere, and what a call takes"
