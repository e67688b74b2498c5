r"""How large an effect must be for data to show it, from the models alone.

Of data without noise, made by the effect at an amplitude a, the ln Bayes factor over none is

.. math:: L(a) = \ln Z_a - \ln Z_0 ,

none being fitted to them: what its coordinates can absorb of the effect is gone. Noise adds about a half to it on
average and scatters it by :math:`\sqrt{2 L}`. The detection limit is where L reaches the threshold: there every other
recording shows the effect.

References: expected significances from data without noise, Cowan et al. 2011, doi:10.1140/epjc/s10052-011-1554-0.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from heartfit.discovery.bench import Bench
from heartfit.discovery.data import Block, Data
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.geometry.arrays import Floats


def expected(none: Hypothesis, single: Hypothesis, blocks: Sequence[Block], x: Floats) -> float | None:
    """L of an effect at the coordinates x (d,) of ``single``; None where a simulation fails.

    The noise of every block has its middle level.
    """
    values = single.forward(x)
    if values is None:
        return None
    bench = Bench(Data(values, tuple(map(_of_known_noise, blocks))))
    there = bench.linear(single, x)
    without = bench.explain(none, x[: len(none.coordinates)])
    if there is None or without is None:
        return None
    return there.log_evidence - without.log_evidence


def _of_known_noise(block: Block) -> Block:
    return replace(block, noise=replace(block.noise, levels=(block.noise.middle,)))


def crossing(sizes: Sequence[float], values: Sequence[float], threshold: float) -> float | None:
    """The least size at which the values, straight between sizes and 0 at 0, reach the threshold; None beyond all."""
    at, seen = np.array([0.0, *sizes]), np.array([0.0, *values])
    above = np.flatnonzero(seen >= threshold)
    if not above.size:
        return None
    i = int(above[0])
    share = (threshold - seen[i - 1]) / (seen[i] - seen[i - 1])
    return float(at[i - 1] + share * (at[i] - at[i - 1]))
