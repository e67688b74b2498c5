"""Whether two groups differ, by all the ways in which their members could have been labelled."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

SAME = 1e-12
"""Relative difference of two sums of the same numbers that is rounding."""


@dataclass(frozen=True)
class PermutationTest:
    """difference of the means, first less second, and the shares of the labelings that are as extreme.

    p: as far from zero; less, greater: as small, as large. None can be below 1 / labelings, the share of the labeling
    that was observed. Reference: Fisher RA 1935, The Design of Experiments, section 21.
    """

    difference: float
    p: float
    less: float
    greater: float
    labelings: int


def permutation_test(first: Sequence[float], second: Sequence[float]) -> PermutationTest:
    """The exact test over all C(a + b, a) labelings; raises ValueError for an empty group."""
    if not (len(first) and len(second)):
        raise ValueError(
            f"permutation: groups of {len(first)} and {len(second)}; expected one member or more each"
        )
    values = np.array([*first, *second])
    differences = np.array(
        [_difference(values, chosen) for chosen in combinations(range(len(values)), len(first))]
    )
    observed, rounding = float(differences[0]), SAME * np.abs(values).sum()
    return PermutationTest(
        observed,
        float((np.abs(differences) >= abs(observed) - rounding).mean()),
        float((differences <= observed + rounding).mean()),
        float((differences >= observed - rounding).mean()),
        len(differences),
    )


def _difference(values: np.ndarray, chosen: Sequence[int]) -> float:
    first = np.isin(np.arange(len(values)), chosen)
    return float(values[first].mean() - values[~first].mean())
