"""Card of a search with the strain of the wall: the verdict, the affected segments, and the evidence."""

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import Parameter
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.wall_model.hypotheses import is_regional
from heartfit.discovery.wall_model.search import WallFindings
from heartfit.discovery.wall_model.territory import probability_of_segments
from heartfit.results.cause_card import spaced_name
from heartfit.results.residual import SEGMENT_NAMES
from heartfit.results.text import AMPLITUDE_UNITS
from heartfit.roles import registered

PROBABLE = 0.5
"""Least probability of a segment that the sentence names."""
LARGEST_LIMIT = 4.0
"""Largest detection limit that is stated [scales]."""
NAMES = (*SEGMENT_NAMES, "apex")
"""Names of the segments 1 to 17."""


def wall_card(findings: WallFindings, title: str) -> str:
    """Return the card as Markdown."""
    parts = [f"# {title}", wall_sentence(findings), _evidence(findings)]
    if findings.regional and (findings.regional,) == findings.decision.effects:
        parts.append(_segments(probability_of_segments(findings.survey.singles, findings.regional)))
    parts.append(_limits(findings))
    return "\n\n".join(parts) + "\n"


def wall_sentence(findings: WallFindings) -> str:
    """Return the verdict as a sentence that a cardiologist reads first."""
    decision = findings.decision
    if decision.verdict == "none":
        return (
            "No missing mechanism detected: volumes, pressures and the strain of the wall are those of a "
            "normal heart of this shape, within their noise."
        )
    if decision.verdict == "unknown":
        return (
            "Something is missing that no single mechanism of the library explains; the strain of the wall "
            "differs from that of every simulated heart."
        )
    names = [_with_size(findings, effects[0]) for effects in (decision.effects, *decision.alternatives)]
    if decision.verdict == "group":
        return f"Missing mechanism: one of {'; '.join(names)}. These data do not distinguish them."
    return f"Missing mechanism: {names[0]} (ln Bayes factor {findings.log_bayes_factor(decision.effects[0]):.1f})."


def _amplitude(name: str) -> Parameter:
    return next(u for u in Candidate.from_mechanism(registered()[name]).unknowns if u.off is not None)


def _with_size(findings: WallFindings, name: str) -> str:
    fit, amplitude = findings.best(name), _amplitude(name)
    middle, low, high = (amplitude.at(value) for value in fit.interval(f"{name}.{amplitude.name}"))
    unit, factor = AMPLITUDE_UNITS.get(amplitude.unit, (amplitude.unit, 1.0))
    size = f"{factor * middle:.2g} ({factor * low:.2g} to {factor * high:.2g}) {unit}".rstrip()
    text = f"{spaced_name(name)}, {amplitude.meaning} {size}"
    if not is_regional(registered()[name]):
        return text
    probability = probability_of_segments(findings.survey.singles, name)
    affected = [NAMES[s] for s in np.flatnonzero(probability > PROBABLE)]
    return f"{text}, in {', '.join(affected) or 'no segment that is more probable than not'}"


def _evidence(findings: WallFindings) -> str:
    base = findings.survey.baseline.log_evidence
    rows = [
        f"| {spaced_name(one.effects[0])} | {one.log_evidence - base:.1f} |"
        for one in findings.survey.singles
    ]
    rows.append(f"| smooth discrepancies of all curves | {findings.discrepancy:.1f} |")
    return "\n".join(["| explanation | ln Bayes factor |", "|---|---|", *rows])


def _segments(probability: Floats) -> str:
    rows = [
        f"| {place + 1} | {NAMES[place]} | {value:.2f} |"
        for place, value in enumerate(probability)
        if value >= 0.05
    ]
    return "\n".join(["| segment | wall | probability |", "|---|---|---|", *rows])


def _limits(findings: WallFindings) -> str:
    """Sizes from which these data would show the effects that are not named."""
    rows = [
        f"| {spaced_name(name)} | {_amplitude(name).meaning} | {_size(name, best)} | {_size(name, worst)} |"
        for name, (best, worst) in findings.limits.items()
        if name not in findings.decision.effects
    ]
    head = (
        "Effects that are not named would be from these sizes, by the linear model; an effect of a region where it "
        "shows most and least."
    )
    return "\n".join(
        [head, "", "| not seen | size | from | from, where it shows least |", "|---|---|---|---|", *rows]
    )


def _size(name: str, scales: float) -> str:
    """Size of an effect with its unit; "not shown" beyond the range in which the linear model holds."""
    if scales > LARGEST_LIMIT:
        return "not shown"
    amplitude = _amplitude(name)
    unit, factor = AMPLITUDE_UNITS.get(amplitude.unit, (amplitude.unit, 1.0))
    return f"{factor * amplitude.at(scales):.2g} {unit}".rstrip()
