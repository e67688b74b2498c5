"""The verdict from the evidences."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from heartfit.discovery.rules import RULES, Rules

Effects = tuple[str, ...]


class Verdict(StrEnum):
    """What the data say is missing from the model."""

    NONE = "none"
    NAMED = "named"
    TWO = "two"
    GROUP = "group"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Evidences:
    """ln Z of everything that was tried: none, singles and pairs by their effects, and the Gaussian process.

    rival: the process alone; on_top: beside the best single effect, and beside the best pair, by effects.
    """

    none: float
    singles: Mapping[Effects, float]
    rival: float
    on_top: Mapping[Effects, float]
    pairs: Mapping[Effects, float]

    @property
    def single(self) -> Effects:
        """The best single effect."""
        return max(self.singles, key=self.singles.__getitem__)

    @property
    def pair(self) -> Effects:
        """The best pair; none if no pair was tried."""
        return max(self.pairs, key=self.pairs.__getitem__, default=())


@dataclass(frozen=True)
class Decision:
    """The verdict, the effects it names and the others that the data do not tell from them."""

    verdict: Verdict
    effects: Effects = ()
    alternatives: tuple[Effects, ...] = ()


def decide(evidences: Evidences, rules: Rules = RULES) -> Decision:
    """What the evidences say under the rules."""
    if not detected(evidences, rules):
        return Decision(Verdict.NONE)
    if _more_than_one(evidences, rules):
        return _of_two(evidences, rules)
    if not named(evidences, rules):
        return Decision(Verdict.UNKNOWN)
    near = _near(evidences.singles, evidences.single, rules)
    return Decision(Verdict.GROUP if near else Verdict.NAMED, evidences.single, near)


def detected(evidences: Evidences, rules: Rules = RULES) -> bool:
    """Whether anything, one of the effects or an unknown one, is there."""
    return _gain(evidences) >= rules.detected


def suspected(evidences: Evidences, rules: Rules = RULES) -> bool:
    """Whether anything may be there, if the fits were better."""
    return _gain(evidences) >= rules.suspected


def _gain(evidences: Evidences) -> float:
    return max(evidences.singles[evidences.single], evidences.rival) - evidences.none


def named(evidences: Evidences, rules: Rules = RULES) -> bool:
    """Whether the best single effect explains what is there."""
    best = evidences.singles[evidences.single]
    gain, margin = best - evidences.none, best - evidences.rival
    left = evidences.on_top[evidences.single] - best
    small = left <= rules.on_top or (margin >= rules.strong and left <= rules.strong_share * gain)
    return gain >= rules.detected and margin >= rules.rival and small


def _more_than_one(evidences: Evidences, rules: Rules) -> bool:
    best = evidences.singles[evidences.single]
    return bool(evidences.pair) and evidences.pairs[evidences.pair] - best >= rules.second


def _of_two(evidences: Evidences, rules: Rules) -> Decision:
    """Two effects, if they explain all; else neither they nor the best single one are named."""
    pair = evidences.pair
    if evidences.on_top[pair] - evidences.pairs[pair] >= rules.on_top:
        return Decision(Verdict.UNKNOWN)
    return Decision(Verdict.TWO, pair, _near(evidences.pairs, pair, rules))


def _near(table: Mapping[Effects, float], best: Effects, rules: Rules) -> tuple[Effects, ...]:
    near = [each for each in table if each != best and table[best] - table[each] < rules.group]
    return tuple(sorted(near, key=table.__getitem__, reverse=True))
