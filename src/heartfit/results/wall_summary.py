"""Summary of a search with the strain of the wall, as card and report show it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.discovery.inference.decide import Verdict
from heartfit.discovery.wall_model.hypotheses import is_regional
from heartfit.discovery.wall_model.search import RULES, WallFindings
from heartfit.discovery.wall_model.territory import probability_of_segments
from heartfit.results.residual import SEGMENT_NAMES
from heartfit.results.text import AMPLITUDE_UNITS, spaced_name
from heartfit.roles import registered

PROBABLE = 0.5
"""Least probability of a segment that the sentence names."""
LARGEST_LIMIT = 4.0
"""Largest detection limit that is stated [scales]."""
NAMES = (*SEGMENT_NAMES, "apex")
"""Names of the segments 1 to 17."""
SMOOTH = "smooth discrepancies of all curves"


@dataclass(frozen=True)
class UnseenEffect:
    """An effect that is not named, the meaning of its size, and the sizes from which these data would show it.

    An effect of a region has one where it shows most, and one where it shows least.
    """

    name: str
    meaning: str
    most_visible: str
    least_visible: str


@dataclass(frozen=True)
class WallSummary:
    """Verdict of a search, as a sentence; ln Bayes factors by explanation; and what was not seen.

    effect: the best effect of a region, empty if none was fitted; probability: of each of the 17 segments, given that
    it is present; named: the effect is the verdict.
    """

    title: str
    verdict: Verdict
    sentence: str
    evidence: Mapping[str, float]
    effect: str
    named: bool
    probability: Sequence[float]
    unseen: Sequence[UnseenEffect]


def summarise_wall(findings: WallFindings, title: str) -> WallSummary:
    """Return the summary of a search."""
    regional = findings.regional
    probability = probability_of_segments(findings.survey.singles, regional).tolist() if regional else []
    gains = {spaced_name(name): gain for name, gain in findings.gains.items()}
    return WallSummary(
        title,
        findings.decision.verdict,
        _sentence(findings),
        gains | {SMOOTH: findings.discrepancy},
        spaced_name(regional) if regional else "",
        bool(regional) and findings.decision.effects == (regional,),
        probability,
        _unseen(findings),
    )


def _sentence(findings: WallFindings) -> str:
    """The verdict as a sentence that a cardiologist reads first."""
    decision = findings.decision
    if decision.verdict == "none":
        largest = max([*findings.gains.values(), findings.discrepancy])
        return (
            "No missing mechanism detected (none) in volumes, pressures and the strain of the wall: the largest ln "
            f"Bayes factor is {largest:.1f}, the threshold is {RULES.detected:g}."
        )
    if decision.verdict == "unknown":
        return (
            "Something is missing that no single mechanism of the library explains; the strain of the wall "
            "differs from that of every simulated heart."
        )
    names = [_with_size(findings, effects[0]) for effects in (decision.effects, *decision.alternatives)]
    if decision.verdict == "group":
        return f"Missing mechanism: one of {'; '.join(names)}. These data do not distinguish them."
    return f"Missing mechanism: {names[0]} ({_evidence(findings)})."


def _evidence(findings: WallFindings) -> str:
    factor = findings.log_bayes_factor(findings.decision.effects[0])
    return f"ln Bayes factor {factor:.1f}, threshold {RULES.detected:g}"


def _with_size(findings: WallFindings, name: str) -> str:
    fit, amplitude = findings.best(name), registered()[name].switch()
    middle, low, high = (amplitude.at(value) for value in fit.interval(f"{name}.{amplitude.name}"))
    unit, factor = AMPLITUDE_UNITS.get(amplitude.unit, (amplitude.unit, 1.0))
    size = f"{factor * middle:.2g} ({factor * low:.2g} to {factor * high:.2g}) {unit}".rstrip()
    text = f"{spaced_name(name)}, {amplitude.meaning} {size}"
    if not is_regional(registered()[name]):
        return text
    probability = probability_of_segments(findings.survey.singles, name)
    affected = [NAMES[s] for s in np.flatnonzero(probability > PROBABLE)]
    return f"{text}, in {', '.join(affected) or 'no segment that is more probable than not'}"


def _unseen(findings: WallFindings) -> list[UnseenEffect]:
    return [
        UnseenEffect(
            spaced_name(name), registered()[name].switch().meaning, _size(name, most), _size(name, least)
        )
        for name, (most, least) in findings.limits.items()
        if name not in findings.decision.effects
    ]


def _size(name: str, scales: float) -> str:
    """Size of an effect with its unit; "not shown" beyond the range in which the linear model holds."""
    if scales > LARGEST_LIMIT:
        return "not shown"
    amplitude = registered()[name].switch()
    unit, factor = AMPLITUDE_UNITS.get(amplitude.unit, (amplitude.unit, 1.0))
    return f"{factor * amplitude.at(scales):.2g} {unit}".rstrip()
