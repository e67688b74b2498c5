"""Of a linear model the promise is the evidence, and two effects that are both there promise more than one."""

from dataclasses import replace

import numpy as np
import pytest
from tests.discovery import oscillator
from tests.discovery.linear import data, hypothesis, slopes

from heartfit.discovery.bench import Bench
from heartfit.discovery.companions import pairs_of
from heartfit.discovery.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.promise import most_promising, promise
from heartfit.discovery.rules import Rules

J = slopes(3)
FURTHER = hypothesis(J, Coordinate("a", one_sided=True, amplitude=True))
Y = J @ np.array([0.5, -1.0, 0.8])


def test_it_is_the_evidence_of_a_linear_model_for_one_simulation() -> None:
    bench = Bench(data(Y))
    base = bench.explain(hypothesis(J[:, :2]), np.zeros(2))
    runs = bench.simulations
    promised = promise(bench, base, FURTHER)
    assert bench.simulations == runs + 1
    found = bench.explain(FURTHER, FURTHER.at(1.0))
    assert promised.log_evidence == pytest.approx(found.log_evidence, rel=1e-6)
    assert promised.start[2] == pytest.approx(found.posterior.mean[2], rel=1e-6)


def test_an_effect_that_is_not_there_starts_where_it_can_still_be_seen() -> None:
    bench = Bench(data(-Y))
    base = bench.explain(hypothesis(J[:, :2]), np.zeros(2))
    assert promise(bench, base, FURTHER).start[2] == 0.3


def test_where_the_typical_size_fails_a_smaller_one_does() -> None:
    bench = Bench(data(Y))
    base = bench.explain(hypothesis(J[:, :2]), np.zeros(2))
    whole = promise(bench, base, FURTHER)
    half = promise(bench, base, replace(FURTHER, forward=lambda x: J @ x if x[2] < 0.5 else None))
    assert half.slopes == pytest.approx(whole.slopes)
    assert promise(bench, base, replace(FURTHER, forward=lambda x: None)) is None


@pytest.mark.parametrize("side", [-1.0, 0.0, 1.0])
def test_an_effect_starts_on_the_side_on_which_it_acts(side) -> None:
    """Where it acts, its second coordinate says which of three columns it adds."""
    shapes = slopes(3, seed=5)
    coordinates = (*FURTHER.coordinates, Coordinate("place"))
    placed = Hypothesis(("a",), coordinates, lambda x: J[:, :2] @ x[:2] + x[2] * shapes[:, round(x[3]) + 1])
    bench = Bench(data(3.0 * shapes[:, int(side) + 1]))
    base = bench.linear(hypothesis(J[:, :2]), np.zeros(2))
    start = most_promising(bench, base, placed, (2.0, 2.0)).start
    assert start[2:] == pytest.approx([2.0, side])


def test_only_pairs_that_promise_enough_are_fitted() -> None:
    truth = oscillator.combined(("delay", "pulse")).forward(np.array([0.5, 0.2, -0.3, 0.1, 2.0, 1.0]))
    bench = Bench(oscillator.observed(truth, 1))
    singles = [bench.explain(each, each.at(1.0)) for each in oscillator.SINGLES]
    ranked = sorted(singles, key=lambda each: -each.log_evidence)
    (pair,) = pairs_of(bench, ranked, oscillator.combined, Rules(promising=10.0))
    assert pair.effects == ("delay", "pulse")
    assert pairs_of(bench, ranked, oscillator.combined, Rules(promising=1e6)) == []
    assert len(pairs_of(bench, ranked, oscillator.combined, Rules(promising=-1e6, pairs=3))) == 3
