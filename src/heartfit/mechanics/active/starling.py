"""Length dependence n_0 of the number of available cross-bridges (Starling effect)."""

from dataclasses import dataclass

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats
from heartfit.parameter import parameter

EXTENSION = np.array([-0.1668, -0.0073, 0.0534, 0.0969, 0.1326, 0.2016, 0.4663, 0.9187, 1.1762])
AVAILABLE = np.array([0.0, 0.5614, 0.7748, 0.8933, 0.9618, 1.0, 1.0, 0.1075, 0.0])


@dataclass(frozen=True)
class Starling:
    r"""Fraction of available bridges at the extension :math:`x = \sqrt{1 + 2 e_c} - 1`.

    .. math:: n_0 = 1 - s\,(1 - n(x + x_0))

    with the piecewise linear table :math:`n` of PhysioBlocks. The slope :math:`s = 0` gives
    :math:`n_0 = 1`, the setting of the public scene of the paper's group; the shift :math:`x_0` accounts for a
    reference configuration that is shorter than slack length.
    """

    slope: float = parameter(0.0, unit="1", symbol="s", meaning="strength of the Starling effect", off=0.0)
    shift: float = parameter(
        0.2, unit="1", symbol="x_0", meaning="extension of the reference over slack length"
    )

    def constants(self) -> Floats:
        return np.array([self.slope, self.shift])

    def available(self, e_c: Floats) -> Floats:
        """n_0 at the contractile strains ``e_c`` (any shape)."""
        result: Floats = _available(np.ravel(e_c), self.constants()).reshape(np.shape(e_c))
        return result


@njit(cache=True, error_model="numpy")
def available(e_c, constants):  # type: ignore[no-untyped-def]
    """n_0 at one strain, of a law with the given slope and shift."""
    slope, shift = constants
    if slope == 0.0:
        return 1.0
    x = np.sqrt(max(1.0 + 2.0 * e_c, 0.0)) - 1.0 + shift
    i = np.searchsorted(EXTENSION, x)
    if i == 0 or i == EXTENSION.size:
        return 1.0 - slope
    part = (x - EXTENSION[i - 1]) / (EXTENSION[i] - EXTENSION[i - 1])
    return 1.0 - slope * (1.0 - AVAILABLE[i - 1] - part * (AVAILABLE[i] - AVAILABLE[i - 1]))


@njit(cache=True, error_model="numpy")
def _available(e_c, constants):  # type: ignore[no-untyped-def]
    result = np.empty(e_c.size)
    for i in range(e_c.size):
        result[i] = available(e_c[i], constants)
    return result
