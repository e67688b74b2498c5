"""Cause card: the sentences in which a diagnosis is read."""

import re
from collections.abc import Iterable, Sequence

import numpy as np

from heartfit.discovery.sphere_model.cause import (
    Cause,
    Change,
    CurveFit,
    Departure,
    Diagnosis,
    Gain,
    Refitted,
    UnnamedCandidate,
    departures,
)
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.results.acting_places import acting_section, acting_sentence, separating_measurement
from heartfit.results.text import AMPLITUDE_UNITS, printed_curve_unit, printed_ratio

CURVES = {
    "lv_volume": "left ventricular volume",
    "lv_pressure": "left ventricular pressure",
    "aorta_pressure": "aortic pressure",
    "rv_volume": "right ventricular volume",
    "rv_pressure": "right ventricular pressure",
}


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict as one sentence: "Missing mechanism: mitral regurgitation, 0.31 cm² (95 % CI ...)."."""
    named = "; ".join(mechanism_with_size(cause) for cause in diagnosis.mechanisms)
    return {
        "none": f"No missing mechanism detected: the simulation explains {_explained_recording(diagnosis)}.",
        "model": "No missing mechanism detected: the misfit is of the size and shape that healthy hearts of other "
        "simulators or controls leave; nothing can be said beyond it.",
        "named": f"Missing mechanism: {named}.",
        "two": f"Missing mechanisms: {named}.",
        "group": f"Missing mechanism: one of {_mechanism_names(diagnosis)}; these data do not distinguish them.",
        "unknown": _unknown(diagnosis),
        "insufficient": "Insufficient data: no conclusion about a missing mechanism.",
    }[diagnosis.verdict]


def _unknown(diagnosis: Diagnosis) -> str:
    where = (
        acting_sentence(diagnosis.acting)
        if diagnosis.acting
        else "No mechanism of the library explains the misfit."
    )
    return f"Unknown missing mechanism. {where}"


def _explained_recording(diagnosis: Diagnosis) -> str:
    """Return "the recording", less the curves that depart, were not searched and are not explained by a refit."""
    departing = {departure.curve for departure in departures(diagnosis) if departure.clear}
    departing -= {fit.curve for fit in diagnosis.fits if fit.within_noise}
    excepted = " and ".join(CURVES[name] for name in sorted(departing & set(diagnosis.unsearched)))
    return f"the recording except the {excepted}, which was not searched" if excepted else "the recording"


def mechanism_with_size(cause: Cause) -> str:
    """Return a mechanism with its size, such as "mitral regurgitation, 0.31 cm² (95 % CI 0.24 to 0.39)"."""
    unit, factor = AMPLITUDE_UNITS.get(cause.unit, (cause.unit, 1.0))
    value, low, high = (f"{factor * amplitude:.3g}" for amplitude in (cause.amplitude, *cause.interval))
    return f"{spaced_name(cause.name)}, {f'{value} {unit}'.strip()} (95 % CI {low} to {high})"


def spaced_name(name: str) -> str:
    """Return the name of a class as words: "mitral regurgitation" for MitralRegurgitation."""
    return re.sub(r"(?<!^)(?=[A-Z])", " ", name).lower()


def candidate_sentence(candidate: UnnamedCandidate) -> str:
    """Return the leading explanation with its sizes, and by which rule it is not named."""
    causes, beside = "; ".join(map(mechanism_with_size, candidate.causes)), candidate.beside_process
    subject = "the pair" if len(candidate.causes) == 2 else "the mechanism"
    side = "above" if beside.over >= 0.0 else "below"
    rules = {
        f"The ln Bayes factor of {subject}, {beside.gain:.1f}, must exceed that of a Gaussian process, "
        f"{beside.gain - beside.over:.1f}, by {beside.required:g}; it is {abs(beside.over):.1f} {side}.": (
            beside.over < beside.required
        ),
        f"A Gaussian process beside {subject} gains {beside.left:.1f} more in ln evidence; "
        f"at most {beside.allowed:.1f} may be left.": beside.left > beside.allowed,
    }
    return " ".join([f"Candidate, not named: {causes}.", *(rule for rule, broken in rules.items() if broken)])


def candidate_names(diagnosis: Diagnosis) -> str:
    """Return the mechanisms of the candidate, joined by "and"; empty without one."""
    causes = diagnosis.candidate.causes if diagnosis.candidate else ()
    return " and ".join(spaced_name(cause.name) for cause in causes)


def _mechanism_names(diagnosis: Diagnosis) -> str:
    return ", ".join(spaced_name(cause.name) for cause in diagnosis.mechanisms)


def markdown_card(diagnosis: Diagnosis, title: str) -> str:
    """Return the card in Markdown: verdict, misfit, evidence, alternatives, next measurement and held-out error."""
    misfits = [f"- {line}" for line in departure_sentences(diagnosis)]
    misfits += [f"- {line}" for line in (*unsearched_sentences(diagnosis), *reading_sentences(diagnosis))]
    parts = [
        f"# {title}\n\n**{verdict_sentence(diagnosis)}**",
        *objection_sentences(diagnosis),
        *([candidate_sentence(diagnosis.candidate)] if diagnosis.candidate else []),
        *([_warnings(diagnosis.warnings)] if diagnosis.warnings else []),
        "## Misfit of the simulation\n\n" + "\n".join(misfits),
        *([f"## Fit in three dimensions\n\n{fits_text(diagnosis.fits)}"] if diagnosis.fits else []),
        *([structure_text(diagnosis)] if diagnosis.structural_scale else []),
        *([f"## Strokes of both ventricles\n\n{strokes_sentence(diagnosis.strokes)}"] if diagnosis.strokes else []),
        *([acting_section(diagnosis.acting)] if diagnosis.acting else []),
        *([_changes(diagnosis.changes)] if diagnosis.changes else []),
        "## Evidence for each mechanism\n\n" + _ranking_table(diagnosis),
        "## Alternative explanations\n\n" + alternatives_text(diagnosis),
        "## Next measurement\n\n" + next_measurement_text(diagnosis),
        f"## Held-out error with {gain_subject(diagnosis)}\n\n" + gains_text(diagnosis.gain),
        *([_final_sizes(diagnosis.from_all_samples)] if diagnosis.from_all_samples else []),
        *([f"## Refit in three dimensions\n\n{refit_section(diagnosis.refitted)}"] if diagnosis.refitted else []),
        *([self_test_sentence(diagnosis)] if diagnosis.self_test is not None else []),
        f"Simulated beats: {diagnosis.simulations}.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def objection_sentences(diagnosis: Diagnosis) -> list[str]:
    """Return one sentence for each held-out curve that the named mechanism makes worse beyond chance."""
    if not diagnosis.mechanisms:
        return []
    return [
        f"Against it: with it the {CURVES.get(gain.curve, gain.curve)} ({gain.on}) fits worse, error ratio "
        f"{printed_ratio(gain.ratio, gain.interval)}."
        for gain in diagnosis.gain
        if gain.objects
    ]


def _warnings(warnings: Iterable[str]) -> str:
    return "## Check the recording first\n\n" + "\n".join(f"- {line}" for line in warnings)


def structure_text(diagnosis: Diagnosis) -> str:
    """Return the section on the misfit that the structure of the model leaves, with its size by curve."""
    sizes = [
        f"{CURVES.get(trace.curve, trace.curve)} {float(np.sqrt(np.mean(trace.structure**2))) / size:.2g} {unit}"
        for trace in diagnosis.traces
        if trace.structure is not None
        for unit, size in [printed_curve_unit(trace.curve)]
    ]
    return (
        "## Difference of structure\n\nHealthy hearts of other simulators, the controls or the earlier recording let "
        f"this simulation err by {' and '.join(sizes)} (root mean square; scale {diagnosis.structural_scale:g}). A "
        "mechanism is named for what this does not explain."
    )


def strokes_sentence(strokes: Strokes) -> str:
    """Return what both ventricles eject, and what their difference may mean."""
    left, right, difference, sd = (
        f"{1e6 * one:.0f}" for one in (strokes.left, strokes.right, abs(strokes.difference), strokes.sd)
    )
    ejected = f"The left ventricle ejects {left} mL in a beat and the right one {right} mL."
    if not strokes.differ:
        return f"{ejected} The difference of {difference} ± {sd} mL is within what the volumes err by."
    cause = (
        "the mitral or the aortic valve leaks, or blood passes from the left to the right ventricle"
        if strokes.difference > 0.0
        else "the tricuspid or the pulmonary valve leaks, or blood passes from the left to the right atrium"
    )
    return f"{ejected} The difference of {difference} ± {sd} mL exceeds what the volumes err by: {cause}."


def _changes(changes: Iterable[Change]) -> str:
    """Return the section on the parameters that changed since the earlier recording."""
    return "## Changes since the earlier recording\n\n" + "\n".join(map(change_line, changes))


def change_line(change: Change) -> str:
    """Return "- `tissue.active.sigma_0`: 1.31 times (95 % CI 1.10 to 1.55)", or a difference in ms or without unit."""
    factor, form, unit = {"ratio": (1.0, ".2f", " times"), "s": (1e3, "+.0f", " ms"), "1": (1.0, "+.2f", "")}[
        change.unit
    ]
    value, low, high = (format(factor * one, form) for one in (change.value, *change.interval))
    return f"- `{change.name}`: {value}{unit} (95 % CI {low} to {high})"


def self_test_sentence(diagnosis: Diagnosis) -> str:
    """Return the largest ln Bayes factor in beats without a hidden effect, and the detection threshold."""
    return (
        "The largest ln Bayes factor in beats of the model without a hidden effect is "
        f"{diagnosis.self_test:.1f} (median); the detection threshold is {diagnosis.threshold:g}."
    )


def departure_sentences(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Return one sentence per curve about its greatest departure."""
    return tuple(map(departure_sentence, departures(diagnosis)))


def departure_sentence(departure: Departure) -> str:
    """Return "aortic pressure: simulation 0.8 ± 0.2 kPa too low in ejection (4.0 standard deviations, 120 ms ...)."."""
    curve, (unit, size_of_unit) = (
        CURVES.get(departure.curve, departure.curve),
        printed_curve_unit(departure.curve),
    )
    if not departure.clear:
        return f"{curve}: no misfit beyond the noise."
    factor = 1.0 / size_of_unit
    size, sd = factor * abs(departure.size), factor * departure.sd
    return (
        f"{curve}: simulation {size:.2g} ± {sd:.1g} {unit} {direction_and_phase(departure)} "
        f"({abs(departure.deviations):.1f} standard deviations, {1e3 * departure.time:.0f} ms after the trigger)."
    )


def direction_and_phase(departure: Departure) -> str:
    """Return "too low in ejection", or "too low" where the beat has no phases."""
    direction = "too high" if departure.size > 0.0 else "too low"
    return f"{direction} in {departure.phase}" if departure.phase else direction


def unsearched_sentences(diagnosis: Diagnosis) -> list[str]:
    """Return one sentence per recorded curve that the search left out, with the reason."""
    return [
        f"{CURVES[name]}: not searched, because {reason}." for name, reason in diagnosis.unsearched.items()
    ]


def reading_sentences(diagnosis: Diagnosis) -> list[str]:
    """Return one sentence per curve that was read twice: its noise, and what the two readings share."""
    return [
        f"{CURVES[name]}: read twice; the difference of both readings gives a noise of {deviation / size:.1f} {unit}, "
        "in which an error that they share, as of the length of the cavity, does not show."
        for name, deviation in diagnosis.read_twice.items()
        for unit, size in [printed_curve_unit(name)]
    ]


def fits_text(fits: Iterable[CurveFit]) -> str:
    """Return one line per curve: whether the refit without a mechanism explains it to within its noise."""
    return "\n".join(
        f"- {CURVES.get(fit.curve, fit.curve)}: the refitted ventricles without a mechanism "
        f"{'explain it to within its noise' if fit.within_noise else 'miss it by more than its noise'} (chi-squared "
        f"{fit.chi_squared:.1f} of {fit.freedom:.1f} degrees of freedom, p = {fit.p:.2g})."
        for fit in fits
    )


def next_measurement_text(diagnosis: Diagnosis) -> str:
    """Return the measurement that would decide between the alternatives, if one is needed."""
    if diagnosis.acting:
        return separating_measurement(diagnosis.acting)
    return diagnosis.next_measurement or "None: the data decide."


def _ranking_table(diagnosis: Diagnosis) -> str:
    lines = [f"| {spaced_name(name)} | {value:.1f} |" for name, value in list(diagnosis.ranking.items())[:6]]
    return "| mechanism | ln Bayes factor over baseline |\n|---|---|\n" + "\n".join(lines)


def alternatives_text(diagnosis: Diagnosis) -> str:
    """Return the alternatives as a list, or one sentence with the reason for none."""
    if diagnosis.withdrawn:
        names = ", ".join(map(spaced_name, diagnosis.withdrawn))
        elsewhere = (
            ", or a function that acts elsewhere explains all samples better" if diagnosis.acting else ""
        )
        return (
            f"Withdrawn: {names}. The fit to the searched data improves, "
            f"but the held-out error does not{elsewhere}."
        )
    if diagnosis.candidate:
        return "None in the library: the candidate leads, but is not named."
    if diagnosis.verdict == "unknown":
        best = next(name for name in diagnosis.ranking if name != "unknown")
        return (
            f"None in the library: the best candidate, {spaced_name(best)}, leaves a misfit beyond the noise."
        )
    if not diagnosis.alternatives:
        return "None in the library within a ln Bayes factor of 3."
    return "\n".join(f"- {' and '.join(map(spaced_name, effects))}" for effects in diagnosis.alternatives)


def refit_section(refitted: Refitted) -> str:
    """Return the evidence of the refit in three dimensions and a table of the parameters without and with it."""
    added = "; ".join(mechanism_with_size(cause) for cause in refitted.extension)
    convergence = (
        "Both refits converged" if refitted.converged else "A refit had not converged at its last step"
    )
    changes = [
        f"| {name} | {refitted.none[name]:.3g} | {value:.3g} | {100.0 * (value / refitted.none[name] - 1.0):+.0f} |"
        for name, value in refitted.extended.items()
    ]
    return (
        f"Extension of the model: {added}. Its ln Bayes factor is {refitted.ln_bayes_factor:.1f} over the model "
        f"without it; both were fitted to half of the samples in {refitted.simulations} beats. {convergence}."
        f"{' ' if refitted.from_all_samples else ''}{_final_sizes(refitted.from_all_samples)}\n\n"
        "| parameter (SI) | without | with | change (%) |\n|---|---|---|---|\n" + "\n".join(changes)
    )


def _final_sizes(causes: Sequence[Cause]) -> str:
    """Return the sentence on the sizes from both halves of the samples, empty where they were not computed."""
    sizes = "; ".join(map(mechanism_with_size, causes))
    return f"From all samples, after the other half has judged: {sizes}." if sizes else ""


def gain_subject(diagnosis: Diagnosis) -> str:
    """Return "the named mechanism", or the extension that was refitted although none is named."""
    if diagnosis.acting:
        return "a free function at the best place"
    if diagnosis.candidate and not diagnosis.refitted:
        return "the candidate, which is not named"
    if diagnosis.mechanisms or not diagnosis.refitted:
        return "the named mechanism"
    refitted = " and ".join(spaced_name(cause.name) for cause in diagnosis.refitted.extension)
    return f"{refitted} ({'candidate' if diagnosis.candidate else 'refitted'}, not named)"


def gains_text(gains: Iterable[Gain]) -> str:
    """Return the ratios of the held-out errors with and without the mechanism as a list.

    A recording too short for two halves names mechanisms that nothing judges.
    """
    lines = [
        f"- {CURVES.get(gain.curve, gain.curve)} ({gain.on}): error ratio {gain.ratio:.2f} "
        f"(95 % CI {gain.interval[0]:.2f} to {gain.interval[1]:.2f})"
        for gain in gains
    ]
    return (
        "\n".join(lines)
        or "None: no mechanism is named, or the recording is too short for a half that judges."
    )
