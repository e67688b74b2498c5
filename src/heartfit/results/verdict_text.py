"""The headline of a diagnosis, and the lines below it: evidence with its threshold, and what the sizes are."""

from collections.abc import Iterable

import numpy as np

from heartfit.discovery.inference.margin import CLOSE, Margin
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis
from heartfit.discovery.sphere_model.misfit import departures
from heartfit.results.acting_places import acting_sentence
from heartfit.results.text import AMPLITUDE_UNITS, CURVES, printed_ratio, spaced_name
from heartfit.roles import registered

UNKNOWN = "unknown"
"""Name of a smooth discrepancy in a ranking."""
SILENT = ("none", "model")
"""Verdicts without a missing mechanism."""


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict as one sentence: "Missing mechanism: mitral regurgitation, 0.31 cm² (95 % CI ...)."."""
    named = "; ".join(map(mechanism_with_size, diagnosis.named))
    return {
        "none": f"No missing mechanism detected (none): {_silence(diagnosis)}.",
        "model": f"No missing mechanism detected (model): {_silence(diagnosis)}. The misfit is of the size and shape "
        "that healthy hearts of other simulators or controls leave.",
        "named": f"Missing mechanism: {named}.",
        "two": f"Missing mechanisms: {named}.",
        "group": f"Missing mechanism: one of {_mechanism_names(diagnosis)}; these data do not distinguish them.",
        "unknown": _unknown(diagnosis),
        "insufficient": "Insufficient data: no conclusion about a missing mechanism.",
    }[diagnosis.verdict]


def _silence(diagnosis: Diagnosis) -> str:
    """Return why nothing is named: the largest ln Bayes factor with its threshold, and curves that were left out."""
    _, factor = strongest(diagnosis)
    best = "nothing was tried" if np.isnan(factor) else f"the largest ln Bayes factor is {factor:.1f}"
    return f"{best}, the threshold is {diagnosis.threshold:g}{_left_out(diagnosis)}"


def _left_out(diagnosis: Diagnosis) -> str:
    """Return the end of the sentence on curves that depart and were not searched."""
    departing = {departure.curve for departure in departures(diagnosis) if departure.clear}
    departing -= {fit.curve for fit in diagnosis.fits if fit.within_noise}
    names = " and ".join(CURVES[name] for name in sorted(departing & set(diagnosis.unsearched)))
    return (
        f". This is of the searched curves: the {names}, which the simulation misses, was not searched"
        if names
        else ""
    )


def _unknown(diagnosis: Diagnosis) -> str:
    where = (
        acting_sentence(diagnosis.acting)
        if diagnosis.acting
        else "No mechanism of the library explains the misfit."
    )
    return f"Unknown missing mechanism. {where}"


def _mechanism_names(diagnosis: Diagnosis) -> str:
    return ", ".join(spaced_name(cause.name) for cause in diagnosis.mechanisms)


def explanation_name(name: str) -> str:
    """Return a mechanism of a ranking as words, or what stands for an unknown one."""
    return "unknown (smooth error)" if name == UNKNOWN else spaced_name(name)


def strongest(diagnosis: Diagnosis) -> tuple[str, float]:
    """Return the explanation with the largest ln Bayes factor of a ranking, and NaN where nothing was tried."""
    return max(diagnosis.ranking.items(), key=lambda item: item[1], default=("", float("nan")))


def mechanism_with_size(cause: Cause) -> str:
    """Return a mechanism with its size, such as "mitral regurgitation, 0.31 cm² (95 % CI 0.24 to 0.39)"."""
    unit, factor = AMPLITUDE_UNITS.get(cause.unit, (cause.unit, 1.0))
    value, low, high = (f"{factor * amplitude:.3g}" for amplitude in (cause.amplitude, *cause.interval))
    size = (
        f"{value} {unit} (95 % CI {low} to {high})" if unit else f"{value} (no unit, 95 % CI {low} to {high})"
    )
    return f"{spaced_name(cause.name)}, {size}"


def verdict_lines(diagnosis: Diagnosis) -> list[str]:
    """Return the lines below the headline, one fact each."""
    candidate = [candidate_sentence(diagnosis)] if diagnosis.candidate else []
    close = [close_sentence(diagnosis.margin)] if diagnosis.margin else []
    objections = objection_lines(diagnosis)
    return [*evidence_lines(diagnosis), *close, *candidate, *size_lines(diagnosis), *objections]


def objection_lines(diagnosis: Diagnosis) -> list[str]:
    """Return one line for each held-out curve that a name or a candidate makes worse beyond chance."""
    if not (diagnosis.mechanisms or diagnosis.candidate):
        return []
    return [
        f"Against it: the {CURVES.get(gain.curve, gain.curve)} ({gain.on}) fits worse with it, error ratio "
        f"{printed_ratio(gain.ratio, gain.interval)}."
        for gain in diagnosis.gain
        if gain.objects
    ]


def candidate_causes(diagnosis: Diagnosis) -> tuple[Cause, ...]:
    """Return the mechanisms of the candidate; none without one."""
    return diagnosis.candidate.causes if diagnosis.candidate else ()


def candidate_names(diagnosis: Diagnosis) -> str:
    """Return the mechanisms of the candidate, joined by "and"; empty without one."""
    return " and ".join(spaced_name(cause.name) for cause in candidate_causes(diagnosis))


def candidate_sentence(diagnosis: Diagnosis) -> str:
    """Return the leading explanation with its sizes, and by which rule it is not named."""
    assert diagnosis.candidate is not None
    causes, beside = (
        diagnosis.with_stated_sizes(diagnosis.candidate.causes),
        diagnosis.candidate.beside_process,
    )
    subject = "the pair" if len(causes) == 2 else "the mechanism"
    side = "above" if beside.over >= 0.0 else "below"
    rules = {
        f"The ln Bayes factor of {subject}, {beside.gain:.1f}, must exceed that of a Gaussian process, "
        f"{beside.gain - beside.over:.1f}, by {beside.required:g}; it is {abs(beside.over):.1f} {side}.": (
            beside.over < beside.required
        ),
        f"A Gaussian process added to {subject} gains {beside.left:.1f} more in ln evidence; "
        f"at most {beside.allowed:.1f} may be left.": beside.left > beside.allowed,
    }
    named = "; ".join(map(mechanism_with_size, causes))
    return " ".join([f"Candidate, not named: {named}.", *(rule for rule, broken in rules.items() if broken)])


def evidence_lines(diagnosis: Diagnosis) -> Iterable[str]:
    """Yield the ln Bayes factor of what is named, or the largest one, with the threshold of a detection.

    The headline of a verdict without a missing mechanism says it itself.
    """
    name, factor = _told_evidence(diagnosis)
    if diagnosis.verdict not in SILENT and not np.isnan(factor):
        yield (
            f"ln Bayes factor of {name} over no mechanism: {factor:.1f}; threshold of a detection: "
            f"{diagnosis.threshold:g}."
        )


def _told_evidence(diagnosis: Diagnosis) -> tuple[str, float]:
    """Return the explanation of the headline and its ln Bayes factor, the strongest one where none is named."""
    if diagnosis.acting:
        return f"{diagnosis.acting[0].slot}, from all samples,", diagnosis.acting[0].ln_bayes_factor
    if diagnosis.mechanisms:
        first = diagnosis.mechanisms[0]
        named = diagnosis.mechanisms if diagnosis.verdict == "two" else (first,)
        return " with ".join(spaced_name(cause.name) for cause in named), first.ln_bayes_factor
    name, factor = strongest(diagnosis)
    return explanation_name(name), factor


def size_lines(diagnosis: Diagnosis) -> Iterable[str]:
    """Yield what the size of each named mechanism measures, and from which samples and model it comes."""
    if diagnosis.verdict == "group":
        return
    sized = diagnosis.with_stated_sizes(diagnosis.mechanisms or candidate_causes(diagnosis))
    for cause in sized:
        kind = registered().get(cause.name)
        if kind is not None:
            yield f"Size of {spaced_name(cause.name)}: {kind.switch().meaning}."
    if sized:
        model = "the refit in three dimensions" if diagnosis.refitted else "the fit of the sphere"
        final = (diagnosis.refitted or diagnosis).from_all_samples
        samples = "all samples; half of them chose the name" if final else "the samples that choose"
        yield f"Sizes are from {model} to {samples}."


def close_sentence(margin: Margin) -> str:
    """Return "Close decision: the search would give "none" if the ln evidence of catheter offset were 0.21 lower"."""
    words = {"baseline": "the model without a mechanism", UNKNOWN: "a smooth error of the model"}
    whose = " and ".join(words.get(name, spaced_name(name)) for name in margin.explanation)
    of = f"a smooth error on top of {whose}" if margin.on_top else whose
    direction = "higher" if margin.change > 0.0 else "lower"
    return (
        f'Close decision: the search would give "{margin.verdict}" if the ln evidence of {of} were '
        f"{abs(margin.change):.2f} {direction}; numerical errors may move it by {CLOSE:g}."
    )
