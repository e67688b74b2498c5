"""What the observations of one heart owe to each of its parameters, carried over to others."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.fixed import covariance_of_fixed
from heartfit.errors import InputError


@dataclass(frozen=True, eq=False)
class Slopes:
    """Relative derivatives dln Z / dln p (k, m) of the observations of one heart, by parameter and observation."""

    parameters: tuple[str, ...]
    observations: tuple[str, ...]
    relative: np.ndarray

    def covariance(self, estimated: Collection[str], observed: Mapping[str, float], sd: float) -> np.ndarray:
        """R_fixed (m, m), in the units and order of `observed`, of all parameters that are not estimated.

        The relative derivatives of the one heart are taken for any. Raises InputError for an observation that the
        slopes do not know, or whose slope is not a number.
        """
        unknown = sorted(set(observed) - set(self.observations))
        if unknown:
            raise InputError(
                f"slopes: nothing of {', '.join(unknown)}; there are {', '.join(self.observations)}"
            )
        rows = [row for row, name in enumerate(self.parameters) if name not in estimated]
        columns = [self.observations.index(name) for name in observed]
        slopes = self.relative[np.ix_(rows, columns)] * np.array(list(observed.values()))
        if not np.isfinite(slopes).all():
            bad = [
                self.parameters[row]
                for row, found in zip(rows, slopes, strict=True)
                if not np.isfinite(found).all()
            ]
            raise InputError(
                f"slopes: {', '.join(bad)} not a number; expected completed beats on both sides of it"
            )
        return covariance_of_fixed(slopes, np.full(len(rows), sd))
