"""What the linear model about one fit promises of a further effect, for a single simulation.

The effect is switched on at its typical size; the secant takes the place of its slope. The promise tells where the fit
of both may start and ranks what to fit first; it is no evidence, since a strong effect bends the way to it.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.discovery.bench import Bench
from heartfit.discovery.evidence import posterior
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.geometry.arrays import Floats

REACH = (0.3, 3.0)
"""Amplitudes between which a fit starts: what else is unknown of an effect shows only if it is on."""


@dataclass(frozen=True, eq=False)
class Promise:
    """A hypothesis with where its fit may start (d,), slopes (n, d) to begin with, and ln Z as it seems from here."""

    hypothesis: Hypothesis
    start: Floats
    slopes: Floats
    log_evidence: float

    def kept(self, bench: Bench, trusted: int = 0) -> Explanation | None:
        """The fit from there, or None where its simulations fail."""
        return bench.explain(self.hypothesis, self.start, self.slopes, trusted)


def most_promising(
    bench: Bench, known: Explanation, further: Hypothesis, reach: tuple[float, float] = REACH
) -> Promise | None:
    """The best of the promises of an effect."""
    return max(promises(bench, known, further, reach), key=lambda each: each.log_evidence, default=None)


def promises(
    bench: Bench, known: Explanation, further: Hypothesis, reach: tuple[float, float] = REACH
) -> list[Promise]:
    """What an effect promises, whatever else is unknown of it as expected or one step to either side.

    Where and when an effect acts bends the way to it so much that a fit stays on the side on which it starts.
    """
    found = [promise(bench, known, further, beside, reach) for beside in _placements(known, further)]
    return [each for each in found if each is not None]


def _placements(known: Explanation, further: Hypothesis) -> list[Floats]:
    """Coordinates (d,) of the further effect's other unknowns: all at 0, and each at -1 and at 1."""
    names = known.fit.hypothesis.names
    others = [i for i, each in enumerate(further.coordinates) if not (each.amplitude or each.name in names)]
    unit = np.eye(len(further.names))
    return [np.zeros(len(further.names)), *(sign * unit[i] for i in others for sign in (-1.0, 1.0))]


def promise(
    bench: Bench,
    known: Explanation,
    further: Hypothesis,
    beside: Floats | float = 0.0,
    reach: tuple[float, float] = REACH,
) -> Promise | None:
    """The promise of a hypothesis that adds one effect to a fitted one, or None where its simulation fails.

    beside (d,): what else is unknown of the effect; reach: the least and the largest amplitude to start from.
    """
    old = np.array([further.names.index(name) for name in known.fit.hypothesis.names], dtype=np.int64)
    new = further.amplitudes & ~np.isin(np.arange(len(further.names)), old)
    x = np.zeros(len(further.names)) + beside
    x[old] = known.fit.x
    secant = _secant(bench, further, x, new, known.fit.predicted)
    if secant is None:
        return None
    slopes = np.zeros((known.fit.predicted.size, x.size))
    slopes[:, old] = known.fit.jacobian
    slopes[:, new] = secant[:, None]
    residual = bench.data.values - known.fit.predicted
    seen = posterior(bench.whitening, x, residual, slopes, further.one_sided)
    sign = np.where(further.one_sided | (seen.mean > 0.0), 1.0, -1.0)
    start = np.where(new, sign * np.clip(sign * seen.mean, *reach), x)
    return Promise(further, start, slopes, seen.log_evidence)


def _secant(bench: Bench, further: Hypothesis, x: Floats, new: np.ndarray, before: Floats) -> Floats | None:
    """The change (n,) that the new amplitude makes, over the amplitude: 1 or, should that fail, the least."""
    for amplitude in (1.0, REACH[0]):
        switched = bench.simulate(further, np.where(new, amplitude, x))
        if switched is not None:
            return (switched - before) / amplitude
    return None
