"""How often the intervals of a noise model hold the truth of sequences it has not seen."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import betaincinv

from heartfit.geometry.arrays import Floats
from heartfit.observation.noise_model import NoiseModel, Setting
from heartfit.observation.pair import Pair

SILENT = 1e-9
"""Standard deviation over the stroke volume below which a phase has no error to be covered."""


@dataclass(frozen=True)
class Share:
    """The share of ``sequences`` that are covered, and the exact interval of the probability behind it.

    Reference: Clopper CJ, Pearson ES 1934, doi 10.1093/biomet/26.4.404.
    """

    covered: float
    sequences: int
    low: float
    high: float

    @classmethod
    def of(cls, covered: float, sequences: int, level: float = 0.95) -> "Share":
        """covered: number of the sequences that are."""
        missed, tail = sequences - covered, 0.5 * (1.0 - level)
        low = float(betaincinv(covered, missed + 1.0, tail)) if covered > 0.0 else 0.0
        high = float(betaincinv(covered + 1.0, missed, 1.0 - tail)) if missed > 0.0 else 1.0
        return cls(covered / sequences, sequences, low, high)


def coverage(model: NoiseModel, pairs: Sequence[Pair], level: float = 0.95) -> dict[str, Share]:
    """The share of fresh pairs whose truth lies within the model's interval, by observation and of "lv_volume".

    That of the volume is the mean over the phases. The phases of one sequence err together, so its interval takes a
    sequence, not a phase, as one trial: it is rather too wide.
    """
    return _shares([_held(model, pair, level) for pair in pairs])


def coverage_of_left_out(
    pairs: Sequence[Pair], protocol: Mapping[str, Setting], level: float = 0.95
) -> dict[str, Share]:
    """The same where each pair in turn is judged by the model of all others."""
    held = [
        _held(NoiseModel.of([*pairs[:index], *pairs[index + 1 :]], protocol), pair, level)
        for index, pair in enumerate(pairs)
    ]
    return _shares(held)


def _shares(held: Sequence[Mapping[str, float]]) -> dict[str, Share]:
    return {name: Share.of(sum(each[name] for each in held), len(held)) for name in held[0]}


def _held(model: NoiseModel, pair: Pair, level: float) -> dict[str, float]:
    """1 or 0 for each observation, for the volume the share of the phases."""
    true = pair.true.observations
    intervals = model.interval(pair.measured, level)
    held = {name: float(low <= true[name] <= high) for name, (low, high) in intervals.items()}
    return held | {"lv_volume": float(np.mean(_phases_held(model, pair, level)))}


def _phases_held(model: NoiseModel, pair: Pair, level: float) -> Floats:
    low, high = model.curve_interval(pair.measured.curves["lv_volume"], level)
    true = pair.true.curves["lv_volume"].resampled(len(low)).values
    return ((low <= true) & (true <= high))[model.curve.sd > SILENT].astype(float)
