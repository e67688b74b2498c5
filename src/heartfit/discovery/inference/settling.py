"""Settled fits: the end of a descent with mean slopes, at which explanations are compared.

A beat has kinks: a valve opens in one step of time or in the next. A one-sided difference takes the side of a kink on
which a fit has stopped for the slope, and so does the evidence. The mean slope over a finite range does not. Where no
step leads down any more, the slope that is left is a kink's, and its gain is no evidence.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.descent import LONGEST_STEP, Descent, InverseProblem, Schedule
from heartfit.discovery.inference.evidence import Explanation, Fit
from heartfit.discovery.inference.hypothesis import CountedHypothesis

REACH = 0.1
"""Range of mean slopes to either side [prior standard deviations]."""
SETTLING = Schedule(0.02, 0.1, longest_step=LONGEST_STEP, jacobian_refresh=1, active_set=True)
"""Steps are short, and every one has slopes of its own."""
SIMULATION_LIMIT = 400
"""Simulations after which a fit counts as settled: seven Jacobians."""


def settle(context: FitContext, explanation: Explanation) -> Explanation:
    """The explanation at the settled end of its fit."""
    fit, model = explanation.fit, CountedHypothesis(explanation.fit.hypothesis)

    def differences(x: Floats, predicted: Floats, _old: Floats) -> Floats:
        return model.mean_slopes(x, predicted, REACH)

    problem = InverseProblem(model, context.data.values, context.whitening, fit.hypothesis.lower)
    slopes = differences(fit.x, fit.predicted, fit.jacobian)
    descent = Descent(problem, SETTLING, fit.x, fit.predicted, slopes, differences)
    while not descent.ended and model.runs < SIMULATION_LIMIT:
        descent.advance()
    context.simulations += model.runs
    slope, _ = problem.normal(descent.x, descent.predicted, descent.jacobian)
    pushed = (descent.x <= problem.lower) & (slope < 0.0)
    settled = replace(Fit.at_end(fit.hypothesis, descent), kink=np.where(pushed, 0.0, slope))
    return Explanation.from_fit(settled, context.data.values, context.whitening)


def rank(explanations: Iterable[Explanation]) -> tuple[Explanation, ...]:
    """Sort by descending evidence."""
    return tuple(sorted(explanations, key=lambda explanation: explanation.log_evidence, reverse=True))


def settle_leading(
    context: FitContext, explanations: Iterable[Explanation], count: int
) -> tuple[Explanation, ...]:
    """Rank the explanations, the ``count`` best ones settled: one that falls behind gives its place to the next."""
    ranked = rank(explanations)
    while unsettled := [one for one in ranked[:count] if not one.fit.settled]:
        settled = settle(context, unsettled[0])
        ranked = rank(settled if one is unsettled[0] else one for one in ranked)
    return ranked
