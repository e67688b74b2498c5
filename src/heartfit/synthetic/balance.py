r"""Search for the value of a parameter at which both sides of a heart pump the same volume.

Blood that one side pumps into its artery returns to the other one,

.. math:: \int (q_{mitral} - q_{leak}) \, dt = \int q_{pulmonary} \, dt .

A circulation with prescribed atrial pressures does not know this: its sides meet at the right value of one parameter.
"""

from collections.abc import Callable
from functools import cache

from scipy.optimize import brentq

from heartfit.synthetic.campaign import Inadmissible

MOST_RATIOS = 4
"""Number of ratios by which the parameter moves away from its start at most."""


def balancing_value(excess: Callable[[float], float], start: float, ratio: float, tolerance: float) -> float:
    """Value at which the volume ``excess`` that the right side pumps beyond the left one is zero, to ``tolerance``.

    The excess increases with the parameter, which is tried at ``start`` and then at ever more powers of ``ratio``.
    Raises Inadmissible where none of them changes its sign.
    """
    excess = cache(excess)  # the ends of the bracket are asked for again
    value, at_value = start, excess(start)
    factor = ratio if at_value < 0.0 else 1.0 / ratio
    for _ in range(MOST_RATIOS):
        following = excess(factor * value)
        if at_value * following <= 0.0:
            return float(brentq(excess, value, factor * value, xtol=tolerance))
        value, at_value = factor * value, following
    raise Inadmissible("the sides of the heart do not balance")
