"""Tables of performance: verdicts, ratios and exponents of given numbers."""

from itertools import product

import pytest

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.growth import growth
from benchmarks.job import Job
from benchmarks.newton import Newton
from benchmarks.performance import ELEMENTS, Measured, exponent, tables
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
    return Measured(beats, [steps], Job(1.0, 1.1, 0.5, 0.08), SPHERES, now, {"beat, 3k": 0.5})


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


def test_the_tables_show_every_figure_and_its_verdict(measured):
    shown = tables(measured, figures(measured))
    targets = shown["targets"].set_index("figure")
    assert (targets["verdict"] == "**missed**").sum() == 2, "the growth of both elements"
    assert targets.loc["beat of 3k, `mixed`"].tolist() == ["0.5", "0.4", "0.80", "≤ 0.5", "CPU s", "met"]
    assert targets.loc["three beats of 3k"].tolist() == ["", "0.4", "", "", "CPU s", ""], (
        "no target, no earlier"
    )
    (faster,) = targets[targets["target"] == "≥ 1000"].to_dict("records")
    assert (faster["now"], faster["verdict"]) == ("5e+03", "met"), "PhysioBlocks over ours"
    (other,) = shown["newton"].to_dict("records")[1:]
    assert (other["ratio"], other["in use"]) == ("15.0 x", "3000 x"), "1.5 s over 0.1 s, and over 0.2 / 400 s"
    assert shown["spheres"].to_numpy().tolist()[0][1:] == ["0.100", "1.00"], "a beat, and what a call takes"
    assert shown["job"]["s"].tolist() == ["1.10", "1.00", "0.50", "0.50", "0.08"]
