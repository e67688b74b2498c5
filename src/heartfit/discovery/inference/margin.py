"""The margin of a decision: the smallest change of one ln Z that changes it.

Numerical errors move a ln Z by some tenths: a decision with a smaller margin would be another one on another
processor. Changes are tried on a grid, of one ln Z after the other, so that the margin holds for any rules.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.discovery.inference.decide import (
    DEFAULT_RULES,
    Decision,
    Effects,
    Evidences,
    Rules,
    Verdict,
    decide,
)

CLOSE = 0.5
"""Margin [ln Z] below which a decision is close."""
GRID = 0.02
"""Step of the changes [ln Z]."""


@dataclass(frozen=True)
class Margin:
    """A change [ln Z] of one explanation that gives another verdict.

    explanation: its effects, or "baseline" or "unknown", the Gaussian process alone; on_top: of the process on top of
    these effects.
    """

    explanation: tuple[str, ...]
    on_top: bool
    change: float
    verdict: Verdict


def margin(evidences: Evidences, rules: Rules = DEFAULT_RULES, within: float = CLOSE) -> Margin | None:
    """The smallest change of one ln Z that changes the verdict or what it names; None if it is above ``within``.

    It is exact to the step of the grid, from above.
    """
    taken = _named(decide(evidences, rules))
    for size in GRID * np.arange(1, round(within / GRID) + 1):
        for change in (float(size), -float(size)):
            for explanation, on_top, changed in _changed(evidences, change):
                decision = decide(changed, rules)
                if _named(decision) != taken:
                    return Margin(explanation, on_top, change, decision.verdict)
    return None


def _named(decision: Decision) -> tuple[Verdict, frozenset[Effects]]:
    """The verdict and what it names; the order within a group does not count."""
    others = decision.alternatives if decision.verdict == "group" else ()
    return decision.verdict, frozenset((decision.effects, *others))


def _changed(evidences: Evidences, change: float) -> Iterator[tuple[tuple[str, ...], bool, Evidences]]:
    """The evidences with each ln Z in turn changed, and whose it is."""
    yield ("baseline",), False, replace(evidences, baseline=evidences.baseline + change)
    yield ("unknown",), False, replace(evidences, discrepancy=evidences.discrepancy + change)
    for effects in evidences.singles:
        singles = _with(evidences.singles, effects, change)
        yield effects, False, _followed(replace(evidences, singles=singles), evidences)
    for effects in evidences.pairs:
        pairs = _with(evidences.pairs, effects, change)
        yield effects, False, _followed(replace(evidences, pairs=pairs), evidences)
    for effects in evidences.on_top:
        yield effects, True, replace(evidences, on_top=_with(evidences.on_top, effects, change))


def _with(table: Mapping[Effects, float], effects: Effects, change: float) -> dict[Effects, float]:
    return {**table, effects: table[effects] + change}


def _followed(changed: Evidences, before: Evidences) -> Evidences:
    """The changed evidences, where a process gains on top of a new best effect or pair what it gained before."""
    single = before.on_top[before.single] - before.singles[before.single]
    on_top = {changed.single: changed.singles[changed.single] + single}
    if changed.pair:
        pair = before.on_top[before.pair] - before.pairs[before.pair]
        on_top[changed.pair] = changed.pairs[changed.pair] + pair
    return replace(changed, on_top=on_top | dict(before.on_top))
