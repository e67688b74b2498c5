r"""The most probable coordinates of a hypothesis.

Minimises :math:`-\ln p(y - f(x)) + \tfrac12 |x|^2` over x, one-sided coordinates not negative; see
:mod:`heartfit.discovery.descent` for the steps. A fit is converged when no step with fresh slopes promises to change
the objective by 0.05 and the undamped one, which the simulation's roughness may refuse, not by 1.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.discovery.descent import Descent
from heartfit.discovery.forward import Counted
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

LIMIT = 600
"""Simulations after which a fit is given up: three times what most of those from the centre of the priors take."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Where the search of one hypothesis ended: x (d,), predicted (n,), jacobian (n, d).

    objective: the minimised function.
    """

    hypothesis: Hypothesis
    x: Floats
    predicted: Floats
    jacobian: Floats
    objective: float
    converged: bool


def fit(
    model: Counted,
    values: Floats,
    whitening: Whitening,
    start: Floats,
    slopes: Floats | None = None,
    trusted: int = 0,
    target: float = np.inf,
    limit: int = LIMIT,
) -> Fit | None:
    """The most probable coordinates seen from ``start`` (d,), or None where no simulation about it is completed.

    values: the data (n,); slopes: a Jacobian (n, d) to begin with, by finite differences if None, of which the first
    ``trusted`` columns are kept but for Broyden; target: an objective, without the promise of which a fit is given up.
    """
    started = model.started(start)
    if started is None:
        return None
    jacobian = model.jacobian(*started) if slopes is None else slopes
    descent = Descent(model, values, whitening, *started, jacobian, trusted, target)
    descent.fresh = slopes is None
    while not descent.ended and model.runs < limit:
        descent.advance()
    return Fit(
        model.hypothesis,
        descent.x,
        descent.predicted,
        descent.jacobian,
        descent.objective,
        descent.converged,
    )
