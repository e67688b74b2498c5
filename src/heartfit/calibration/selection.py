"""Selection of k of n parameters to estimate, by the singular value decomposition of the normalised Cov(X, Z).

With A = U S V^T, the rows of U S represent the parameters in the space of the distinguishable observations: long for a
strong parameter, parallel for two that the observations do not distinguish. The rule selects the longest row, removes
its direction from all others, and repeats (pivoted QR). After all directions are used, three parameters for three
observations, it restarts with the remaining parameters. The next one is strong, but its effect is a combination of
those already selected, and only the prior distinguishes it from them.

References: Golub and Van Loan, Matrix Computations, section 5.5.6 (subset selection); Marchesseau et al. 2012,
section 3.2, which does not state how the decomposition was interpreted.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from math import comb

import numpy as np

Measure = Callable[[np.ndarray, Sequence[int]], float]
"""Quality of a set of rows of A, given by their indices; larger is better."""

SPENT_LENGTH = 1e-6
"""Length of a remainder over that of the longest row below which it counts as zero."""


def decomposition(covariance: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """U (n, r), singular values (r,), V (m, r); the largest entry of each column of U is positive."""
    left, values, right = np.linalg.svd(covariance, full_matrices=False)
    sign = np.sign(left[np.abs(left).argmax(axis=0), np.arange(len(values))])
    return left * sign, values, right.T * sign


def select(covariance: np.ndarray, count: int) -> list[int]:
    """Return the indices of `count` rows of (n, m) in the order of selection."""
    n = len(covariance)
    if not 0 < count <= n:
        raise ValueError(f"selection: {count} of {n} parameters; expected 1 to {n}")
    left, values, _ = decomposition(covariance)
    chosen: list[int] = []
    while len(chosen) < count:
        rest = [index for index in range(n) if index not in chosen]
        chosen += [rest[index] for index in _pivot_rows((left * values)[rest])]
    return chosen[:count]


def _pivot_rows(rows: np.ndarray) -> Iterator[int]:
    """Yield rows that add a direction, the longest remainder first; at least one."""
    remainder, least = rows.copy(), SPENT_LENGTH * np.linalg.norm(rows, axis=1).max()
    while True:
        lengths = np.linalg.norm(remainder, axis=1)
        index = int(lengths.argmax())
        yield index
        remainder -= np.outer(remainder @ remainder[index], remainder[index]) / max(
            lengths[index] ** 2, 1e-300
        )
        if np.linalg.norm(remainder, axis=1).max() <= least:
            return


def squared_share(covariance: np.ndarray, rows: Sequence[int]) -> float:
    """Share of the squares of A in some rows: the share of the observations' variance that they cause."""
    return float((covariance[list(rows)] ** 2).sum() / (covariance**2).sum())


def volume_share(covariance: np.ndarray, rows: Sequence[int]) -> float:
    """det(A_S^T A_S) / det(A^T A): near one if the rows change all combinations of the observations like all rows.

    Zero if they do not change one combination. It does not depend on the scale of any observation.
    """
    part = covariance[list(rows)]
    return float(np.linalg.det(part.T @ part) / np.linalg.det(covariance.T @ covariance))


def rank_among_all(covariance: np.ndarray, rows: Sequence[int], measure: Measure) -> tuple[int, int]:
    """Place of some rows among all sets of as many, 1 for the largest measure, and the number of sets."""
    own, count = measure(covariance, rows), len(rows)
    better = sum(
        measure(covariance, other) > own * (1 + 1e-12)
        for other in combinations(range(len(covariance)), count)
    )
    return better + 1, comb(len(covariance), count)
