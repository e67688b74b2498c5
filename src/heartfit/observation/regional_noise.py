r"""Noise of the regional curves of registered images, learned from sequences of known truth.

Each kind of curve (circumferential strain, longitudinal strain, descent of the base) has its own noise, which is that
of :mod:`heartfit.observation.gain_noise` with the segments as elements; kinds are independent. Registration shrinks
motion, so that measured curves are those of a model times the mean gain G of their kind,

.. math:: E y = G e, \quad \mathrm{Cov}\, y = \Sigma(e), \quad
          E\, y / G = e, \quad \mathrm{Cov}\, y / G = \Sigma(e) / G^2 .

The covariance grows with the strain e that is expected, because gains multiply it: take e from a model that is near the
heart, and hold it while the model is fitted, or the fit is drawn towards small strains.

The reduced chi-square :math:`(y - G e)^T \Sigma^{-1} (y - G e) / n` over the n samples after phase 0 is about one in a
sequence that the noise describes. Judged by the noise that all other sequences taught, it measures the coverage.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_triangular

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.gain_noise import GainNoise, Pattern, TrackedCurves
from heartfit.observation.noise_model import MIN_SEQUENCES
from heartfit.observation.regional import KINDS, kind_of, names_of_kind, require_common_frames


@dataclass(frozen=True, eq=False)
class RegionalPair:
    """Regional curves of one sequence by name, true and registered, at the same times.

    Raises InputError unless both have all regional curves and all times are equal.
    """

    true: Mapping[str, Curve]
    registered: Mapping[str, Curve]

    def __post_init__(self) -> None:
        for curves in (self.true, self.registered):
            missing = [name for kind in KINDS for name in names_of_kind(kind) if name not in curves]
            if missing:
                raise InputError(
                    f"regional noise: no curve {', '.join(missing)}; expected those of `regional_curves`"
                )
        require_common_frames([*self.true.values(), *self.registered.values()])

    def of_kind(self, kind: str) -> TrackedCurves:
        """Return the curves of a kind, by increasing segment."""
        true, registered = (
            np.array([curves[name].values for name in names_of_kind(kind)])
            for curves in (self.true, self.registered)
        )
        return TrackedCurves(true, registered, self.true[names_of_kind(kind)[0]].times)


@dataclass(frozen=True, eq=False)
class RegionalNoise:
    """Noise of registered regional curves, one for each of KINDS."""

    kinds: Mapping[str, GainNoise]

    @classmethod
    def from_pairs(cls, pairs: Sequence[RegionalPair], pattern: Pattern = "mean") -> "RegionalNoise":
        """Estimate the noise from one pair for each sequence, all of one protocol.

        Raises InputError for fewer than MIN_SEQUENCES pairs.
        """
        if len(pairs) < MIN_SEQUENCES:
            raise InputError(
                f"regional noise: {len(pairs)} sequences; expected at least {MIN_SEQUENCES}: "
                "simulate and register more"
            )
        return cls(
            {
                kind: GainNoise.from_sequences([pair.of_kind(kind) for pair in pairs], pattern)
                for kind in KINDS
            }
        )

    def corrected(self, measured: Mapping[str, Curve]) -> dict[str, Curve]:
        """Return the measured curves over the mean gain of their kind, by name [1, m]."""
        return {
            name: replace(curve, values=curve.values / self._gain(name)) for name, curve in measured.items()
        }

    def expected(self, true: Mapping[str, Curve]) -> dict[str, Curve]:
        """Return the mean of the measured curves where ``true`` are the true ones, by name [1, m]."""
        return {name: replace(curve, values=curve.values * self._gain(name)) for name, curve in true.items()}

    def covariance(self, true: Mapping[str, Curve]) -> Floats:
        """Covariance (n, n) of the measured curves about their mean, curve after curve in the order of ``true``.

        true: the curves that a model expects, all at the frames of the images; n = curves x frames. A strain has the
        unit 1, the descent m. All segments of a direction belong to its mean strain: cut rows of left out segments from
        the covariance of all. Rows of phase 0 are zero; see `later_samples`. Raises InputError for a direction with
        other segments than 1 to 16, and for curves of other names or at different times.
        """
        require_common_frames(true.values())
        names, frames = list(true), next(iter(true.values())).times
        covariance = np.zeros((len(names) * frames.size,) * 2)
        for kind in dict.fromkeys(map(kind_of, names)):
            places = _rows_of_kind(kind, names, frames.size)
            values = np.array([true[name].values for name in names_of_kind(kind)])
            covariance[np.ix_(places, places)] = self.kinds[kind].covariance(values, frames)
        return covariance

    def corrected_covariance(self, true: Mapping[str, Curve]) -> Floats:
        """Covariance (n, n) of the `corrected` curves, as `covariance` but over the gains."""
        gains = np.concatenate([np.full(curve.times.size, self._gain(name)) for name, curve in true.items()])
        covariance: Floats = self.covariance(true) / np.outer(gains, gains)
        return covariance

    def reduced_chi_square(self, pair: RegionalPair, kind: str) -> float:
        """(y - G e)' Sigma^-1 (y - G e) / n [1] of the n samples of a kind after phase 0."""
        return float((self.whitened(pair, kind) ** 2).mean())

    def log_density(self, pair: RegionalPair, kind: str) -> float:
        """ln N(y; G e, Sigma) / n [1] of the n samples of a kind after phase 0, in their unit."""
        _, root = self._residual_and_root(pair, kind)
        spread = np.log(np.diag(root)).mean() + 0.5 * np.log(2.0 * np.pi)
        return float(-0.5 * self.reduced_chi_square(pair, kind) - spread)

    def whitened(self, pair: RegionalPair, kind: str) -> Floats:
        """L^-1 (y - G e) (n,) of the samples of a kind after phase 0, with L the Cholesky factor of their covariance.

        The samples are those of each curve in turn, by increasing segment.
        """
        residual, root = self._residual_and_root(pair, kind)
        white: Floats = np.asarray(solve_triangular(root, residual, lower=True), np.float64)
        return white

    def _residual_and_root(self, pair: RegionalPair, kind: str) -> tuple[Floats, Floats]:
        curves = pair.of_kind(kind)
        true = {name: pair.true[name] for name in names_of_kind(kind)}
        later = later_samples(true)
        residual: Floats = (curves.registered - self.kinds[kind].gain * curves.true).ravel()[later]
        covariance: Floats = self.covariance(true)[np.ix_(later, later)]
        return residual, np.asarray(np.linalg.cholesky(covariance), np.float64)

    def _gain(self, name: str) -> float:
        return self.kinds[kind_of(name)].gain


def later_samples(curves: Mapping[str, Curve]) -> Integers:
    """Places of the samples after phase 0 among those of all curves; phase 0 is the reference and has no noise."""
    sizes = [curve.times.size for curve in curves.values()]
    starts = np.cumsum([0, *sizes])[:-1]
    return np.setdiff1d(np.arange(sum(sizes)), starts)


def leave_one_out(pairs: Sequence[RegionalPair], pattern: Pattern = "mean") -> list[RegionalNoise]:
    """Return for each pair the noise that all other pairs teach, to judge it by.

    Raises InputError where fewer than MIN_SEQUENCES pairs remain.
    """
    return [
        RegionalNoise.from_pairs([*pairs[:place], *pairs[place + 1 :]], pattern)
        for place in range(len(pairs))
    ]


def _rows_of_kind(kind: str, names: Sequence[str], frames: int) -> Integers:
    """Rows of the samples of a kind, by increasing segment."""
    missing = [name for name in names_of_kind(kind) if name not in names]
    if missing:
        raise InputError(
            f"regional noise: no curve {', '.join(missing)}; expected all of the kind {kind}, "
            "because its mean is part of the noise: leave out rows of the covariance instead"
        )
    starts = np.array([names.index(name) * frames for name in names_of_kind(kind)])
    rows: Integers = (starts[:, None] + np.arange(frames)).ravel()
    return rows
