r"""Anderson acceleration of a fixed-point iteration.

A modified Newton iteration with a stale tangent leaves a few slow modes behind; mixing the last changes
removes them at the price of a small least-squares problem.
Source: Walker and Ni, SIAM J. Numer. Anal. 49 (2011) 1715.
"""

import numpy as np

from heartfit.geometry.arrays import Floats

DEPTH = 5


class Anderson:
    """Mixes the proposed changes of an iteration; one instance serves one fixed-point problem."""

    def __init__(self, weights: Floats) -> None:
        self._weights = weights
        self._changes: list[Floats] = []
        self._moves: list[Floats] = []
        self._last: tuple[Floats, Floats] | None = None

    def mix(self, z: Floats, change: Floats) -> Floats:
        """The change to apply at ``z`` (N,) where the plain iteration proposes ``change`` (N,)."""
        if self._last is not None:
            self._moves.append(z - self._last[0])
            self._changes.append(change - self._last[1])
            del self._moves[:-DEPTH], self._changes[:-DEPTH]
        self._last = (z.copy(), change.copy())
        if not self._changes:
            return change
        G, Z = np.array(self._changes).T, np.array(self._moves).T
        gamma = np.linalg.lstsq(G * self._weights[:, None], change * self._weights, rcond=1e-8)[0]
        mixed: Floats = change - (Z + G) @ gamma
        return mixed

    def forget(self) -> None:
        """Start anew: the iteration itself has changed."""
        self._changes, self._moves, self._last = [], [], None
