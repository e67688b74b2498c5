"""Static equilibrium of relaxed ventricles under given cavity pressures."""

from typing import Any

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.body import StepFailed

INCREMENTS = 6
ITERATIONS = 40
FORCE_TOLERANCE = 1e-6  # N: every beat starts from here
CONTRACTION = 0.4
"""A step that shrinks the residual less than this renews the tangent."""


def inflate(body: Any, pressures: Floats, increments: int = INCREMENTS) -> Any:
    """State of ``body`` filled from rest to ``pressures`` (2,), Pa; raises StepFailed if it balloons."""
    state, factor = body.rest(), None
    for share in np.linspace(0.0, 1.0, increments + 1)[1:]:
        state, factor = _equilibrium(body, state, share * pressures, factor)
    return state


def _equilibrium(body: Any, state: Any, pressures: Floats, factor: Any) -> tuple[Any, Any]:
    """The state under ``pressures``, and the factor that led there, to start the next from."""
    step, x, previous = body.endless_step(state), state.x.copy(), np.inf
    for _ in range(ITERATIONS):
        residual = step.forces(x) - body.volume_gradients(x) @ pressures
        size = step.size(residual)
        if size < FORCE_TOLERANCE:
            return step.commit(x), factor
        if factor is None or size > CONTRACTION * previous:
            factor = step.tangent(x)
        previous = size
        x = x - factor.solve(residual).reshape(x.shape)
    raise StepFailed(
        f"no static equilibrium at {pressures[0]:.0f} / {pressures[1]:.0f} Pa, residual {size:.3g} N: "
        "the wall is too soft for this pressure or the supports are too weak"
    )
