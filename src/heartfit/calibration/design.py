"""Where a transform looks: the points about the mean, their weights, and what replaces a point that failed."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from heartfit.errors import InputError


class CalibrationError(InputError):
    """The sigma points that remain do not determine what is asked; the message says which are missing."""


class Design(Protocol):
    """A set of p points for n parameters, the centre first."""

    def labels(self, names: Sequence[str]) -> list[str]:
        """Names (p,) of the points."""

    def offsets(self, n: int) -> np.ndarray:
        """The points (p, n) of a standard Gaussian: mean 0, covariance 1 under the weights."""

    def weights(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        """W^m and W^c, (p,) each."""

    def filled(self, z: np.ndarray, done: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """The observations (p, m) with the rows that are not `done` (p,) as an affine map of the others has them.

        Raises CalibrationError, naming the points, where the others do not say.
        """
