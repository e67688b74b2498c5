"""Later beats use what the beat before has found: where each step ends, and the factors of its tangents."""

from dataclasses import replace

import pytest

from heartfit.heart.beat import Beat
from heartfit.heart.circulation import coupling
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate

STEP = 1e-2


def beats(body: FiniteElementBody, number: int) -> Beat:
    return simulate(Heart(), body, Numerics(time_step=STEP, max_beats=number, drift=0.0))


@pytest.fixture(scope="module")
def first(coarse_body: FiniteElementBody) -> Beat:
    return beats(coarse_body, 1)


@pytest.fixture(scope="module")
def fourth(coarse_body: FiniteElementBody) -> Beat:
    return beats(coarse_body, 4)


def test_later_beats_need_few_new_factors(first: Beat, fourth: Beat) -> None:
    factors = [beat.diagnostics["factorisations"] for beat in (first, fourth)]
    assert factors[1] - factors[0] < factors[0]


def test_later_beats_need_fewer_iterations(first: Beat, fourth: Beat) -> None:
    iterations = [beat.diagnostics["iterations"] for beat in (first, fourth)]
    assert (iterations[1] - iterations[0]) / 3 < 0.9 * iterations[0]


def test_the_limit_cycle_does_not_depend_on_kept_factors(
    coarse_body: FiniteElementBody, fourth: Beat, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(coupling, "LARGEST_REUSED", 0)
    without = beats(coarse_body, 4)
    assert without.diagnostics["factorisations"] > 1.3 * fourth.diagnostics["factorisations"]
    assert without.volume["lv"] == pytest.approx(fourth.volume["lv"], abs=2e-7)


def test_a_tangent_of_a_halved_step_serves_no_whole_one(coarse_body: FiniteElementBody) -> None:
    long = Numerics(time_step=2e-2, max_beats=3, drift=0.0)
    cut = simulate(Heart(), coarse_body, replace(long, tolerances=coupling.Tolerances(iterations=4)))
    assert cut.completed
    assert cut.diagnostics["step_cuts"] > 0
    whole = simulate(Heart(), coarse_body, long)
    assert cut.volume["lv"] == pytest.approx(whole.volume["lv"], abs=3e-6)
