"""Where in the simulated beat the measured time zero lies."""

from collections.abc import Mapping

import numpy as np

from heartfit.observation.curve import Curve


def root_mean_square(measured: Curve, simulated: Curve, shift: float = 0.0) -> float:
    """sqrt(mean over the measured samples of (y(t) - x(t + shift))^2), in the curves' unit."""
    return float(np.sqrt(np.mean((measured.values - simulated(measured.times + shift)) ** 2)))


def require_common_phase(measured: Curve, simulated: Curve) -> None:
    """Raise ValueError if the periods differ by more than a tenth: such beats have no common phase."""
    if abs(measured.period / simulated.period - 1) > 0.1:
        raise ValueError(
            f"alignment: periods of {measured.period:g} s and {simulated.period:g} s; "
            "expected the same heart rate: simulate at the measured period"
        )


def fit_shift(measured: Curve, simulated: Curve, limit: float | None = None) -> float:
    """The shift s in seconds, |s| <= limit (half a period if None), at which x(t + s) fits y(t) best.

    A scan finds the basin, a bounded Brent search the minimum in it. Raises as `require_common_phase` does.
    """
    from scipy.optimize import minimize_scalar

    require_common_phase(measured, simulated)
    reach = simulated.period / 2 if limit is None else limit
    scan, step = np.linspace(-reach, reach, 101, retstep=True)
    start = min(scan, key=lambda shift: root_mean_square(measured, simulated, shift))
    bounds = (max(start - step, -reach), min(start + step, reach))
    found = minimize_scalar(lambda shift: root_mean_square(measured, simulated, shift), bounds=bounds)
    return float(found.x)


def fit_curves(
    measured: Mapping[str, Curve], simulated: Mapping[str, Curve], limit: float
) -> tuple[float, dict[str, float]]:
    """The shift in s, |s| <= limit, that suits the LV volume best, and each common curve's misfit at it."""
    shift = fit_shift(measured["lv_volume"], simulated["lv_volume"], limit)
    common = [name for name in measured if name in simulated]
    return shift, {name: root_mean_square(measured[name], simulated[name], shift) for name in common}
