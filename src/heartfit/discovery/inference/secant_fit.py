r"""Fits of a model whose simulations are expensive, with given slopes.

Each step costs one simulation, after which Broyden's update corrects the slopes:

.. math:: J \to J + \frac{(f(x + s) - f(x) - J s)\, s^T}{s^T s} .
"""

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Whitening
from heartfit.discovery.inference.descent import Descent, InverseProblem, Schedule
from heartfit.discovery.inference.evidence import Fit
from heartfit.discovery.inference.hypothesis import CountedHypothesis

OBJECTIVE_TOLERANCE, LEAST_DAMPING, LONGEST_STEP = 0.3, 0.1, 1.5
"""Predicted decrease that ends a fit [ln Z], damping, and longest step along a coordinate [prior sd]."""
SCHEDULE = Schedule(
    OBJECTIVE_TOLERANCE, LEAST_DAMPING, longest_step=LONGEST_STEP, correct_on_failure=True, active_set=True
)
DIFFERENCE = 0.1
"""Step of the differences along the unknowns of an effect [prior sd]."""


def fit_with_slopes(
    model: CountedHypothesis,
    values: Floats,
    whitening: Whitening,
    x: Floats,
    predicted: Floats,
    jacobian: Floats,
    most: int,
) -> Fit:
    """The end of at most ``most`` steps from x (d,), at which predicted (n,) and slopes ``jacobian`` (n, d) hold."""
    problem = InverseProblem(model, values, whitening, model.hypothesis.lower)
    descent = Descent(problem, SCHEDULE, x, predicted, jacobian)
    for _ in range(most):
        if descent.ended:
            break
        descent.advance()
    return Fit(
        model.hypothesis,
        descent.x,
        descent.predicted,
        descent.jacobian,
        descent.objective,
        descent.converged,
    )


def differences(model: CountedHypothesis, x: Floats, predicted: Floats, columns: range) -> Floats:
    """Slopes (n, k) along some coordinates by one simulation each; zero where it fails."""
    slopes = []
    for index in columns:
        shifted = x.copy()
        shifted[index] += DIFFERENCE
        prediction = model(shifted)
        slopes.append(
            np.zeros_like(predicted) if prediction is None else (prediction - predicted) / DIFFERENCE
        )
    return np.column_stack(slopes)
