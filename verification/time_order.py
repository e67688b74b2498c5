r"""The observed order of the time schemes, on a whole beat of two spheres: fibres, wall, valves and arteries.

Each observation of a beat with steps :math:`\Delta t` is compared with that of the second-order scheme at a step far
below the shortest. Valves open and fibres activate between time levels, so errors scatter from one step to the next:
the order is that of the root mean square over an octave of steps, beside the octave a factor below. Peaks of a rate are
those of the curve through a Gaussian window of 10 ms, as an instrument of finite bandwidth sees them: the peak of a
curve with kinks has no order.
"""

from functools import cache

import numpy as np
import pandas as pd
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

from heartfit.core.arrays import Floats
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from verification.check import AtLeast, Check

NAMES = ("V_min", "q_max", "q_min", "P_max", "dP/dt_max", "dP/dt_min")
COARSE, FACTOR, FINEST = range(60, 120, 3), 6, 8000
"""Steps in a beat: the coarse octave, the factor to the fine one, and what stands for none."""

WINDOW, SAMPLES = 0.010, 3000


@cache
def observed(steps: int, second_order: bool) -> tuple[float, ...]:
    """The observations, SI, of the first beat of the spheres with that many steps."""
    heart = Heart().with_parameters({"sigma_0": 150e3})
    spheres = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
    beat = simulate_spheres(heart, spheres, Numerics(heart.period / steps, second_order, max_beats=1))
    V, q = _smoothed(beat.time, beat.volume["lv"])
    P, dP = _smoothed(beat.time, beat.pressure["lv"])
    return V.min(), q.max(), q.min(), P.max(), dP.max(), dP.min()


def _smoothed(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """The curve through the window, and its rate."""
    fine = np.linspace(time[0], time[-1], SAMPLES + 1)
    smooth = gaussian_filter1d(CubicSpline(time, values)(fine), WINDOW / (fine[1] - fine[0]), mode="nearest")
    return smooth, np.gradient(smooth, fine)


def errors(steps: int, second_order: bool) -> Floats:
    """Relative errors (6,) of the observations."""
    observations, exact = np.array(observed(steps, second_order)), np.array(observed(FINEST, True))
    result: Floats = np.abs(observations / exact - 1.0)
    return result


def orders(second_order: bool) -> dict[str, float]:
    """Observed order of every observation."""
    above, below = (
        np.sqrt(np.mean([errors(k * steps, second_order) ** 2 for steps in COARSE], axis=0))
        for k in (1, FACTOR)
    )
    return dict(zip(NAMES, (np.log(above / below) / np.log(FACTOR)).tolist(), strict=True))


SCHEMES = {"backward Euler": (False, 0.9), "second order": (True, 1.8)}
"""Second order or not, and the least order that is accepted."""

ASKED = tuple(name for name in NAMES if name != "P_max")
USUAL = (85, 170, 340)
"""Steps in a beat of 0.83 s: of 10, 5 and 2.5 ms."""


def time_order_checks() -> list[Check]:
    """One row for each scheme and observation."""
    return [
        AtLeast(f"{scheme}: order of {name}", observations[name], least, 0.0, "1", "order of the scheme")
        for scheme, (second_order, least) in SCHEMES.items()
        for observations in [orders(second_order)]
        for name in ASKED
    ]


def time_order_table() -> pd.DataFrame:
    """Errors of both schemes at the usual steps."""
    rows = (
        (scheme, steps, errors(steps, second)) for scheme, (second, _) in SCHEMES.items() for steps in USUAL
    )
    cells = [
        (scheme, f"{829.0 / steps:.1f}", *(f"{100 * error:.2f} %" for error in relative))
        for scheme, steps, relative in rows
    ]
    return pd.DataFrame(cells, columns=["scheme", "step, ms", *NAMES])
