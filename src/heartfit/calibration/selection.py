"""Selection of k of n parameters to estimate, by the singular value decomposition of the normalised Cov(X, Z).

With A = U S V^T, the rows of U S are the parameters as vectors in the space of what the observations tell apart: long
for a strong parameter, parallel for two that the observations cannot tell from each other. The rule takes the longest
row, removes its direction from all others, and repeats (pivoted QR). Once every direction is spent, after three
parameters for three observations, it starts anew among those that are left: the next one is then strong, but its
effect is a combination of those already chosen, and only the prior tells it from them.

References: Golub and Van Loan, Matrix Computations, section 5.5.6 (subset selection); Marchesseau et al. 2012,
section 3.2, which does not say how the decomposition was read.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from math import comb

import numpy as np

Measure = Callable[[np.ndarray, Sequence[int]], float]
"""Quality of rows of A, by their indices: the larger, the better."""

SPENT_LENGTH = 1e-6
"""Length of a remainder, over the longest row, that counts as nothing."""


def decomposition(covariance: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """U (n, r), singular values (r,), V (m, r); the largest entry of each column of U is positive."""
    left, values, right = np.linalg.svd(covariance, full_matrices=False)
    sign = np.sign(left[np.abs(left).argmax(axis=0), np.arange(len(values))])
    return left * sign, values, right.T * sign


def select(covariance: np.ndarray, count: int) -> list[int]:
    """Indices of `count` rows of (n, m), in the order in which the rule takes them."""
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
    """Rows that add a direction, the longest remainder first; at least one."""
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
    """Share of the squares of A in some rows: how much of the observations' variance they are to blame for."""
    return float((covariance[list(rows)] ** 2).sum() / (covariance**2).sum())


def volume_share(covariance: np.ndarray, rows: Sequence[int]) -> float:
    """det(A_S^T A_S) / det(A^T A): near one if the rows move all combinations of the observations as all do.

    Zero if they leave one unmoved. It does not depend on the scale of any observation.
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
