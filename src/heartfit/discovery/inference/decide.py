"""Verdicts from differences of ln evidence.

Measured on simulated hearts by a prototype of this search, 80 without an effect and 150 with one: among 18 mechanisms
the best one reaches ln BF 4.2 in one of twenty hearts without an effect, so that the usual 3 of Kass and Raftery (1995)
would give a false alarm in one of nine.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal


@dataclass(frozen=True)
class Rules:
    """Thresholds in ln evidence.

    - detected: the best explanation over the baseline, below which the verdict is "none"; 5 where the model differs
      from the data's source by integrator, valves and roughness, more where its structure differs (see
      CENTRED_RULES and
      STRICT_RULES).
    - detected_beside_structure: the same where even the best effect leaves what the structure of another model leaves.
    - suspected: the same after the first round of fits, below which there is no second.
    - start_amplitude: the amplitude with which every effect starts from the prior mean; from 1 a leak of 3 is missed.
    - refitted, respread: number of effects in the second round, and number of these that start again from every
      placement, with slopes of their own.
    - settled: number of best effects, and of best pairs, that are settled, twice the three that are compared: settling
      moves ln Z by up to 0.8.
    - over_discrepancy: the leading explanation, one effect or two, over the Gaussian process alone.
    - on_top: the largest gain of a Gaussian process on top of the named explanation.
    - strong, strong_share: an explanation over the Gaussian process by ``strong`` is named although one on top of it
      gains, if that is at most ``strong_share`` of the explanation's gain: a strong effect reveals a small error of
      its model.
    - second: a pair over the best single effect, above which one effect does not suffice; at 3, one in twenty single
      effects is given a false companion.
    - group: effects within this of the best cannot be told apart (Kass and Raftery's "positive").
    - polished, polish: number of best effects that start again from these amplitudes before the verdict "unknown".
    - partners, pairs, predicted_gain: number of best single effects that are combined with a second one, the largest
      number of pairs that are fitted, and the least predicted gain of a pair over the better of its effects.
    """

    detected: float = 5.0
    detected_beside_structure: float = 25.0
    suspected: float = 2.0
    start_amplitude: float = 2.0
    refitted: int = 8
    respread: int = 2
    settled: int = 6
    over_discrepancy: float = 2.0
    on_top: float = 4.0
    strong: float = 10.0
    strong_share: float = 0.35
    second: float = 7.0
    group: float = 3.0
    polished: int = 6
    polish: tuple[float, ...] = (0.7, 3.0)
    partners: int = 4
    pairs: int = 6
    predicted_gain: float = 2.0

    def beside_structure(self, scale: float) -> "Rules":
        """Return the rules where structure of this scale is the most probable one given the best effect."""
        if scale == 0.0:
            return self
        detected = max(self.detected, self.detected_beside_structure)
        return replace(self, detected=detected, suspected=self.suspected + detected - self.detected)


DEFAULT_RULES = Rules()
CENTRED_RULES = Rules(detected=7.0)
"""For data of a 3-D heart and a sphere that is centred on a 3-D beat of it: of nine such hearts without an effect,
observed through images, the largest ln Bayes factors were 5.9, 5.6 and 5.0."""
CHANGE_RULES = Rules(detected_beside_structure=5.0, over_discrepancy=0.0, strong=0.0, strong_share=0.5)
"""For a change of one heart, whose earlier recording has told what the model lacks. Its effect may follow another law
than that of the library: up to half of its gain may remain for a smooth discrepancy."""
STRICT_RULES = Rules(detected=10.0)
"""For a model that differs in structure from the source of the data and is not centred on it."""

Effects = tuple[str, ...]
"""Names of the effects of a hypothesis, empty for the baseline."""


Verdict = Literal["none", "model", "named", "two", "group", "unknown", "insufficient"]
"""Conclusion about missing effects. Evidences alone never give "insufficient", which is for data that could not show an
effect, nor "model", for a misfit of the size and shape that the structure of another model leaves."""


@dataclass(frozen=True)
class Evidences:
    """ln Z of all fitted explanations: baseline, singles and pairs by their effects, and the Gaussian process.

    discrepancy: the process added to the baseline; on_top: the process added to the best single effect and to the best
    pair, by effects.
    """

    baseline: float
    singles: Mapping[Effects, float]
    discrepancy: float
    on_top: Mapping[Effects, float]
    pairs: Mapping[Effects, float]

    @property
    def single(self) -> Effects:
        """The best single effect."""
        return max(self.singles, key=self.singles.__getitem__)

    @property
    def pair(self) -> Effects:
        """The best pair; empty if no pair was tried."""
        return max(self.pairs, key=self.pairs.__getitem__, default=())

    def log_evidence(self, effects: Effects) -> float:
        """ln Z of one effect or of a pair; raises KeyError for effects that were not fitted."""
        return {**self.singles, **self.pairs}[effects]


@dataclass(frozen=True)
class Decision:
    """Return the verdict, the named effects, and the alternatives that the data do not distinguish from them."""

    verdict: Verdict
    effects: Effects = ()
    alternatives: tuple[Effects, ...] = ()


def decide(evidences: Evidences, rules: Rules = DEFAULT_RULES) -> Decision:
    """The decision that follows from the evidences under the rules, which are the same for one effect and for two."""
    if not is_detected(evidences, rules):
        return Decision("none")
    leading = leading_effects(evidences, rules)
    if not is_explained(evidences, leading, rules):
        return Decision("unknown")
    if leading in evidences.pairs:
        return Decision("two", leading, _alternatives(evidences.pairs, leading, rules))
    alternatives = _alternatives(evidences.singles, leading, rules)
    return Decision("group" if alternatives else "named", leading, alternatives)


def is_detected(evidences: Evidences, rules: Rules = DEFAULT_RULES) -> bool:
    """True if the evidence for any effect, of the library or unknown, reaches the threshold."""
    return _largest_gain(evidences) >= rules.detected


def is_suspected(evidences: Evidences, rules: Rules = DEFAULT_RULES) -> bool:
    """True if better fits might detect an effect."""
    return _largest_gain(evidences) >= rules.suspected


def _largest_gain(evidences: Evidences) -> float:
    return max(evidences.singles[evidences.single], evidences.discrepancy) - evidences.baseline


def leading_effects(evidences: Evidences, rules: Rules = DEFAULT_RULES) -> Effects:
    """The effects of the best explanation: a pair only where one effect does not suffice."""
    best, pair = evidences.singles[evidences.single], evidences.pair
    return pair if pair and evidences.pairs[pair] - best >= rules.second else evidences.single


@dataclass(frozen=True)
class BesideProcess:
    """An explanation compared with the Gaussian process, in ln evidence.

    gain, over: over the baseline and over the process alone; left: gain of a process on top of it; required, allowed:
    the least ``over`` and the largest ``left`` of an explanation that is named.
    """

    gain: float
    over: float
    left: float
    required: float
    allowed: float

    @classmethod
    def of(cls, evidences: Evidences, effects: Effects, rules: Rules = DEFAULT_RULES) -> "BesideProcess":
        """Compare these effects, the best single one or the best pair, with the process."""
        best = evidences.log_evidence(effects)
        gain, over = best - evidences.baseline, best - evidences.discrepancy
        left = evidences.on_top[effects] - best
        share = rules.strong_share * gain if over >= rules.strong else 0.0
        return cls(gain, over, left, rules.over_discrepancy, max(rules.on_top, share))

    @property
    def better(self) -> bool:
        """True if the explanation is better than the process by enough, and leaves little for it."""
        return self.over >= self.required and self.left <= self.allowed


def is_explained(evidences: Evidences, effects: Effects, rules: Rules = DEFAULT_RULES) -> bool:
    """True if these effects, the best single one or the best pair, explain the data."""
    beside = BesideProcess.of(evidences, effects, rules)
    return beside.gain >= rules.detected and beside.better


def _alternatives(table: Mapping[Effects, float], best: Effects, rules: Rules) -> tuple[Effects, ...]:
    near = [effects for effects in table if effects != best and table[best] - table[effects] < rules.group]
    return tuple(sorted(near, key=table.__getitem__, reverse=True))
