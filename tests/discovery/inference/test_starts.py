"""Starts of the fits: each is needed for an effect that the others miss, on curves in closed form."""

import numpy as np
import pytest

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.decide import DEFAULT_RULES, Rules
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.inference.search import fit_from_baseline, search, survey_singles
from tests.discovery.inference.linear import TIMES, data

RAMP, FLAT = 2.0 * (TIMES - TIMES.mean()), np.ones(TIMES.size)
ZIGZAG = np.where(np.arange(TIMES.size) % 2 == 0, 2.0, -2.0)
EFFECT = Coordinate("effect", one_sided=True, amplitude=True)
NONE = Hypothesis((), (Coordinate("slope"),), lambda x: x[0] * RAMP)


def never(names: tuple[str, str]) -> Hypothesis:
    raise AssertionError(f"no second effect to combine with {names}")


def test_an_effect_that_the_fit_of_the_baseline_hides_is_found_from_the_prior_mean() -> None:
    """It adds its curve near the prior mean only, and the ramp in it draws the baseline away from there."""
    shape = 8.0 * RAMP + 2.0 * ZIGZAG
    hidden = Hypothesis(
        ("effect",),
        (*NONE.coordinates, EFFECT),
        lambda x: NONE.forward(x[:1]) + x[1] * np.exp(-(x[0] ** 4)) * shape / 3.0,
    )
    context = FitContext(data(shape))
    none = context.explain(NONE, np.zeros(1))
    dragged = fit_from_baseline(context, none, hidden)
    assert none.fit.x[0] > 2.0
    assert dragged.log_evidence - none.log_evidence < DEFAULT_RULES.suspected
    (effect,) = survey_singles(context, NONE, [hidden], Rules(suspected=np.inf)).singles  # no second round
    assert effect.log_evidence - none.log_evidence > 3.0 * DEFAULT_RULES.detected
    assert effect.fit.x == pytest.approx([0.0, 3.0], abs=0.3)


def test_an_effect_that_starts_too_weak_is_found_from_other_amplitudes() -> None:
    """Below 3.5 it adds a constant that the data lack, beyond a zigzag, which no slope below announces."""
    late = Hypothesis(
        ("effect",),
        (*NONE.coordinates, EFFECT),
        lambda x: NONE.forward(x[:1]) + (0.2 * x[1] * FLAT if x[1] < 3.5 else x[1] / 4.0 * ZIGZAG),
    )
    verdicts = {
        polish: search(data(ZIGZAG), NONE, [late], never, Rules(polish=polish)).decision.verdict
        for polish in ((), (0.7,), (0.7, 4.0))
    }
    assert verdicts == {(): "unknown", (0.7,): "unknown", (0.7, 4.0): "named"}
