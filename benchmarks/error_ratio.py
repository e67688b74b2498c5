"""Coverage of the interval of an error ratio: python -m benchmarks.error_ratio

Errors of two models of equal size and of half the size, drawn as first-order autoregressions. Stores
docs/measured/error_ratio.tsv. The prior of the correlation was chosen on other seeds. Half a minute of one core.
"""

import sys
from collections.abc import Iterator
from itertools import product

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from heartfit.core.arrays import Floats
from heartfit.discovery.inference.error_ratio import error_ratio

SEED, DRAWS = 101, 1000
SHARED = (0.5, 0.72)
"""Correlations of both errors: that of half the error which is all noise, and about that of hidden1 of the study."""
CORRELATIONS = ((0.0, 0.0), (0.2, 0.2), (0.4, 0.4), (0.7, 0.7), (0.7, 0.2))
"""Correlations of errors that are one step apart, without and with the mechanism."""
BLOCKS = np.concatenate([np.arange(4.0) + 8.0 * block for block in range(10)])
SAMPLES = {
    "12 frames": (np.arange(12.0), 1, 0.0),
    "25 frames": (np.arange(25.0), 1, 0.0),
    "40 pressures in 10 blocks": (BLOCKS, 1, 0.0),
    "25 frames of 17 segments": (np.arange(25.0), 17, 0.5),
}
"""Times of the samples, number of segments and correlation between segments."""


def main() -> None:
    """Score the interval and store the table."""
    table = pd.DataFrame(list(rows(np.random.default_rng(SEED))))
    store_table("error_ratio", table, "benchmarks.error_ratio")
    sys.stdout.write(f"{table.to_string(index=False)}\n")


def rows(rng: np.random.Generator) -> Iterator[dict[str, str]]:
    """Yield one row for each number of samples and correlation."""
    for samples, (times, segments, alike) in SAMPLES.items():
        for correlations in CORRELATIONS:
            named = " and ".join(map(str, sorted({*correlations})))
            row = {"samples": samples, "correlation of neighbours": named}
            for ratio, shared in product((1.0, 0.5), SHARED):
                drawn = (errors(rng, times, correlations, segments, alike, shared) for _ in range(DRAWS))
                low, high = np.array(
                    [
                        error_ratio(np.repeat(times, segments), first, ratio * second)[1]
                        for first, second in drawn
                    ]
                ).T
                held, better = (
                    100.0 * np.mean(share) for share in ((low <= ratio) & (ratio <= high), high < 1.0)
                )
                row[f"ratio {ratio:g}, shared {shared:g}: held, called better (%)"] = (
                    f"{held:.1f}, {better:.1f}"
                )
            yield row


def errors(
    rng: np.random.Generator,
    times: Floats,
    correlations: tuple[float, float],
    segments: int,
    alike: float,
    shared: float,
) -> Floats:
    """Draw errors (2, t segments) of unit size, without and with the mechanism."""
    lags = np.abs(times[:, None] - times)
    across = np.linalg.cholesky((1.0 - alike) * np.eye(segments) + alike)
    own, extended = (
        np.linalg.cholesky(rho**lags) @ rng.standard_normal((times.size, segments)) @ across.T
        for rho in correlations
    )
    return np.array([(shared * extended + np.sqrt(1.0 - shared**2) * own).ravel(), extended.ravel()])


if __name__ == "__main__":
    main()
