"""Search on an oscillator: it names the hidden effect, and none without a hidden effect."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.inference.hypothesis import Hypothesis
from heartfit.discovery.inference.search import Findings, search
from tests.discovery.inference import oscillator


def searched(truth: np.ndarray, seed: int) -> Findings:
    return search(oscillator.observed(truth, seed), oscillator.NONE, oscillator.SINGLES, oscillator.combined)


def base(seed: int) -> np.ndarray:
    return np.random.default_rng(1000 + seed).standard_normal(4)


@pytest.mark.parametrize(
    ("name", "amplitude"), [("clipping", 3.0), ("delay", -2.5), ("drift", 3.0), ("pulse", 1.0)]
)
def test_a_hidden_effect_is_named_and_its_interval_holds_it(name, amplitude) -> None:
    result = searched(oscillator.EFFECTS[name][1](base(4), amplitude), 4)
    assert result.decision.effects == (name,)
    _, low, high = result.best.interval(name, 0.99)
    assert low < amplitude < high


def test_two_hidden_effects_are_both_named() -> None:
    truth = oscillator.combined(("delay", "pulse")).forward(np.array([*base(1), 2.0, 1.0]))
    result = searched(truth, 1)
    assert result.decision.verdict == "two"
    assert result.decision.effects == ("delay", "pulse")


def test_a_departure_without_an_effect_is_unknown_and_is_located() -> None:
    truth = oscillator.curves(base(2))
    truth[:24] += 0.4 * np.exp(-0.5 * ((oscillator.TIMES - 0.35) / 0.05) ** 2)
    result = searched(truth, 2)
    assert result.decision.verdict == "unknown"
    position, _ = result.baseline_discrepancy
    assert oscillator.TIMES[np.argmax(position.mean)] == pytest.approx(0.35, abs=0.05)


def bump() -> np.ndarray:
    """A departure of the position that no effect has."""
    shape = np.zeros(oscillator.curves(base(2)).size)
    shape[:24] = 0.4 * np.exp(-0.5 * ((oscillator.TIMES - 0.35) / 0.05) ** 2)
    return shape


def within(shape: np.ndarray, data: Data) -> Findings:
    """Search data with a structural covariance of this shape."""
    structured = replace(data, structure=np.outer(shape, shape))
    return search(structured, oscillator.NONE, oscillator.SINGLES, oscillator.combined)


def test_a_departure_of_the_shape_that_structure_has_is_no_effect() -> None:
    data = oscillator.observed(oscillator.curves(base(2)) + bump(), 2)
    result = within(bump(), data)
    assert result.decision.verdict == "none"
    assert result.structural_scale > 0.0
    assert result.rules.detected == result.rules.detected_beside_structure


def test_an_effect_that_leaves_nothing_to_structure_needs_no_more_evidence() -> None:
    truth = oscillator.EFFECTS["clipping"][1](base(4), 3.0)
    result = within(bump(), oscillator.observed(truth, 4))
    assert result.decision.effects == ("clipping",)
    assert result.rules.detected == DEFAULT_RULES.detected


def test_no_hypothesis_fits_worse_than_none() -> None:
    for seed in range(5):
        result = searched(oscillator.curves(base(seed)), seed)
        for single in result.survey.singles:
            assert single.fit.converged
            assert single.fit.objective <= result.survey.baseline.fit.objective + 0.05


def test_the_simulations_are_counted() -> None:
    runs = 0

    def counted(hypothesis: Hypothesis) -> Hypothesis:
        def forward(x: np.ndarray) -> np.ndarray | None:
            nonlocal runs
            runs += 1
            return hypothesis.forward(x)

        return Hypothesis(hypothesis.effects, hypothesis.coordinates, forward)

    result = search(
        oscillator.observed(oscillator.curves(base(0), pulse=2.0), 0),
        counted(oscillator.NONE),
        [counted(single) for single in oscillator.SINGLES],
        lambda names: counted(oscillator.combined(names)),
    )
    assert result.simulations == runs


def test_invalid_data_and_failing_models_are_refused() -> None:
    dead = Hypothesis((), oscillator.BASE, lambda x: None)
    with pytest.raises(InputError, match=r"centre.*prior"):
        search(
            oscillator.observed(oscillator.curves(base(0)), 0), dead, oscillator.SINGLES, oscillator.combined
        )
    block = Block("y", "m", np.arange(3.0), 1.0, Noise((1.0,), 0.0, 0.1, discrepancy=1.0))
    with pytest.raises(InputError, match="3"):
        Data(np.zeros(2), (block,))
    with pytest.raises(InputError, match="not finite"):
        Data(np.array([0.0, np.nan, 0.0]), (block,))
