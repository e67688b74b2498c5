r"""What a cause gains where nothing was fitted.

Half of the recording: every other beat or, of a single one, every other frame and every other 50 ms of pressure.
Without and with the cause the model is fitted to the one half and predicts the other. Another condition: the fitted
model beats at its rate, and only its loading, the atrial pressure and the peripheral resistance, is found anew.

The ratio of the errors has an interval by a bootstrap over eighths of the beat: errors of neighbouring samples are not
independent.
"""

from dataclasses import dataclass, replace
from math import exp

import numpy as np

from heartfit.diagnosis.cause import Gain
from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.library import Candidate, hypothesis
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.bench import Bench
from heartfit.discovery.data import Data
from heartfit.discovery.hypothesis import Coordinate, Hypothesis
from heartfit.geometry.arrays import Floats

BLOCK = 0.05
"""s of pressure that are kept or held out together."""
LOADING = {"circulation.left_atrium": 0.3, "circulation.systemic.R_p": 0.3}
"""What another condition may change, and the standard deviations of the logarithms of the change."""
PARTS, DRAWS = 8, 2000


@dataclass(frozen=True, eq=False)
class Predicted:
    """Held-out data and what was predicted of them, (n,), without and with the cause."""

    on: str
    data: Data
    none: Floats
    extended: Floats

    def helps(self) -> bool:
        """Whether the cause makes the held-out data likelier."""
        return self.gained() > 0.0

    def gained(self) -> float:
        """ln likelihood of the held-out data with the cause over without."""
        whitening = Bench(self.data).whitening
        none, extended = (
            whitening.log_likelihood(self.data.values - each) for each in (self.none, self.extended)
        )
        return extended - none

    def gains(self) -> tuple[Gain, ...]:
        """Curve by curve."""
        return tuple(self._gain(index) for index in range(len(self.data.blocks)))

    def _gain(self, index: int) -> Gain:
        block, rows = self.data.blocks[index], self.data.rows[index]
        none, extended = ((self.data.values - each)[rows] for each in (self.none, self.extended))
        ratio, interval = error_ratio(np.mod(block.times, block.period) / block.period, none, extended)
        before, after = (float(np.sqrt(np.mean(each**2))) for each in (none, extended))
        return Gain(block.curve, self.on, before, after, ratio, interval)


def error_ratio(phase: Floats, none: Floats, extended: Floats) -> tuple[float, tuple[float, float]]:
    """Ratio of the root mean square errors (k,) with the cause and without, and its 95 % interval over the phases."""
    part = np.minimum((phase * PARTS).astype(int), PARTS - 1)
    sums = np.array([np.bincount(part, each**2, PARTS) for each in (none, extended)])
    drawn = np.random.default_rng(0).integers(PARTS, size=(DRAWS, PARTS))
    totals = np.maximum(sums[:, drawn].sum(axis=2), np.finfo(float).tiny)
    low, high = np.quantile(np.sqrt(totals[1] / totals[0]), [0.025, 0.975]).tolist()
    return float(np.sqrt(sums[1].sum() / sums[0].sum())), (low, high)


def on_half(
    centre: Centre, data: Data, effects: tuple[Candidate, ...], none: Floats, extended: Floats
) -> Predicted | None:
    """What either model predicts of one half when fitted to the other; None where a fit fails.

    none, extended: coordinates of the fits to all data, from which those to the half start.
    """
    masks = [_kept(block.times, block.period, block.curve) for block in data.blocks]
    kept, held = (_part(data, [mask == side for mask in masks]) for side in (True, False))
    pairs = (((), none), (effects, extended))
    predictions = [_refitted(centre, kept, held, each, start) for each, start in pairs]
    if predictions[0] is None or predictions[1] is None:
        return None
    return Predicted("half of the recording", held, predictions[0], predictions[1])


def _kept(times: Floats, period: float, curve: str) -> np.ndarray:
    """Which samples are fitted."""
    if np.ptp(times) > 1.5 * period:
        return np.floor(times / period).astype(int) % 2 == 0
    if curve.endswith("_volume"):
        return np.arange(times.size) % 2 == 0
    return np.floor(times / BLOCK).astype(int) % 2 == 0


def _part(data: Data, masks: list[np.ndarray]) -> Data:
    blocks = tuple(
        replace(block, times=block.times[mask]) for block, mask in zip(data.blocks, masks, strict=True)
    )
    return Data(data.values[np.concatenate(masks)], blocks)


def _refitted(
    centre: Centre, kept: Data, held: Data, effects: tuple[Candidate, ...], start: Floats
) -> Floats | None:
    found = Bench(kept).explain(hypothesis(_twin(centre, kept), effects), start)
    return None if found is None else hypothesis(_twin(centre, held), effects).forward(found.fit.x)


def _twin(centre: Centre, data: Data) -> Twin:
    return Twin(centre, {block.curve: block.times for block in data.blocks})


def in_condition(
    name: str,
    centre: Centre,
    data: Data,
    effects: tuple[Candidate, ...],
    none: Floats,
    extended: Floats,
) -> Predicted | None:
    """What either fitted model predicts of another condition, its loading found anew; None where a fit fails."""
    slower = centre.beating(data.blocks[0].period)
    pairs = (((), none), (effects, extended))
    predictions = [_reloaded(slower, data, each, x) for each, x in pairs]
    if predictions[0] is None or predictions[1] is None:
        return None
    return Predicted(name, data, predictions[0], predictions[1])


def _reloaded(centre: Centre, data: Data, effects: tuple[Candidate, ...], x: Floats) -> Floats | None:
    def forward(change: Floats) -> Floats | None:
        pairs = zip(LOADING.items(), change.tolist(), strict=True)
        changed = {path: centre.values[path] * exp(sd * z) for (path, sd), z in pairs}
        loaded = replace(centre, heart=centre.heart.with_parameters(changed))
        return hypothesis(_twin(loaded, data), effects).forward(x)

    loading = Hypothesis((), tuple(Coordinate(path) for path in LOADING), forward)
    found = Bench(data).explain(loading, loading.at(0.0))
    return None if found is None else found.fit.predicted
