"""Cause card: the sections in which a diagnosis is read, below one headline."""

from collections.abc import Iterable

import numpy as np

from heartfit.discovery.sphere_model.cause import Change, Diagnosis, Gain, Refitted
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.results.acting_places import acting_section, separating_measurement
from heartfit.results.misfit_text import added_name, misfit_lines
from heartfit.results.text import CURVES, printed_curve_unit, spaced_name
from heartfit.results.verdict_text import (
    explanation_name,
    mechanism_with_size,
    verdict_lines,
    verdict_sentence,
)


def markdown_card(diagnosis: Diagnosis, title: str) -> str:
    """Return the card in Markdown: headline, misfit, evidence, alternatives, next measurement and held-out error."""
    parts = [
        f"# {title}\n\n**{verdict_sentence(diagnosis)}**",
        *verdict_lines(diagnosis),
        *([_warnings(diagnosis.warnings)] if diagnosis.warnings else []),
        "## Misfit\n\n" + "\n".join(f"- {line}" for line in misfit_lines(diagnosis)),
        *([structure_text(diagnosis)] if diagnosis.structural_scale else []),
        *([f"## Strokes of both ventricles\n\n{strokes_sentence(diagnosis.strokes)}"] if diagnosis.strokes else []),
        *([acting_section(diagnosis.acting, diagnosis.threshold)] if diagnosis.acting else []),
        *([_changes(diagnosis.changes)] if diagnosis.changes else []),
        "## Evidence for each mechanism\n\n" + _ranking_table(diagnosis),
        "## Alternative explanations\n\n" + alternatives_text(diagnosis),
        "## Next measurement\n\n" + next_measurement_text(diagnosis),
        f"## Held-out error{gain_subject(diagnosis)}\n\n" + gains_text(diagnosis.gain),
        *([f"## Refit in three dimensions\n\n{refit_section(diagnosis)}"] if diagnosis.refitted else []),
        *([self_test_sentence(diagnosis)] if diagnosis.self_test is not None else []),
        f"Simulated beats: {diagnosis.simulations}.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


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
    allowed = any(np.any(trace.structure) for trace in diagnosis.traces if trace.structure is not None)
    size = f"{diagnosis.structural_scale:g} times as large as usual"
    if diagnosis.mechanisms and not allowed:
        explained = (
            f"Without a mechanism the fit explains part of the misfit by such a difference, {size}; with the mechanism "
            "it needs none."
        )
    else:
        explained = (
            f"The fit explains {' and '.join(sizes)} of the misfit by such a difference (root mean square; {size}). A "
            "mechanism is named for what this does not explain."
        )
    return (
        "## Difference of structure\n\nHealthy hearts, too, differ from this simulation: those of other simulators, or "
        f"your controls or earlier recording. {explained}"
    )


def strokes_sentence(strokes: Strokes) -> str:
    """Return what both ventricles eject, and what their difference may mean."""
    left, right, difference, sd = (
        f"{1e6 * one:.0f}" for one in (strokes.left, strokes.right, abs(strokes.difference), strokes.sd)
    )
    ejected = f"The left ventricle ejects {left} mL in a beat and the right one {right} mL."
    if not strokes.differ:
        return f"{ejected} The difference of {difference} ± {sd} mL is within what the volumes err by."
    reasons = (
        "a leak of the mitral or the aortic valve, blood that passes from the left to the right ventricle, or a right "
        "ventricle that images or labels hold incompletely"
        if strokes.difference > 0.0
        else "a leak of the tricuspid or the pulmonary valve, blood that passes from the left to the right atrium, or "
        "a left ventricle that images or labels hold incompletely"
    )
    return (
        f"{ejected} The difference of {difference} ± {sd} mL exceeds what the volumes err by. Volumes alone do not "
        f"tell the reason: {reasons}."
    )


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


def next_measurement_text(diagnosis: Diagnosis) -> str:
    """Return the measurement that would decide between the alternatives, if one is needed."""
    if diagnosis.acting:
        return separating_measurement(diagnosis.acting)
    if diagnosis.next_measurement:
        return f"{diagnosis.next_measurement[0].upper()}{diagnosis.next_measurement[1:]}."
    decided = diagnosis.verdict in ("none", "model", "named", "two")
    return "None is needed to choose between mechanisms." if decided else "None was found that would decide."


def _ranking_table(diagnosis: Diagnosis) -> str:
    rows = [
        f"| {explanation_name(name)} | {value:z.1f} |" for name, value in list(diagnosis.ranking.items())[:6]
    ]
    head = f"| explanation | ln Bayes factor over no mechanism (threshold {diagnosis.threshold:g}) |"
    return "\n".join([head, "|---|---|", *rows])


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
        best = next((name for name in diagnosis.ranking if name != "unknown"), "")
        return (
            f"None in the library: a smooth error of the model, in place of the best candidate{_named(best)} or on top "
            "of it, is more probable."
        )
    if not diagnosis.alternatives:
        return "None in the library within a ln Bayes factor of 3."
    return "\n".join(f"- {' and '.join(map(spaced_name, effects))}" for effects in diagnosis.alternatives)


def _named(name: str) -> str:
    return f", {spaced_name(name)}," if name else ""


def refit_section(diagnosis: Diagnosis) -> str:
    """Return the evidence of the refit in three dimensions and a table of the parameters without and with it.

    A mechanism that is not named is told here with its size; that of a named one and of a candidate is above.
    """
    refitted = diagnosis.refitted
    assert refitted is not None
    changes = [
        f"| {name} | {refitted.none[name]:.3g} | {value:.3g} | {100.0 * (value / refitted.none[name] - 1.0):+.0f} |"
        for name, value in refitted.extended.items()
    ]
    convergence = (
        "Both refits converged" if refitted.converged else "A refit had not converged at its last step"
    )
    return (
        f"{_extension(diagnosis, refitted)} The ln Bayes factor of this refit over the one without it is "
        f"{refitted.ln_bayes_factor:.1f}; it is kept above the threshold of 0 if the held-out error falls, too. Both "
        f"were fitted to half of the samples, in {refitted.simulations} beats. {convergence}.\n\n"
        "| parameter (SI) | without | with | change (%) |\n|---|---|---|---|\n" + "\n".join(changes)
    )


def _extension(diagnosis: Diagnosis, refitted: Refitted) -> str:
    named = {cause.name for cause in diagnosis.mechanisms}
    sized_above = named if diagnosis.verdict != "group" else set()
    sized_above |= {cause.name for cause in diagnosis.candidate.causes} if diagnosis.candidate else set()
    final = {cause.name: cause for cause in refitted.from_all_samples}
    extension = [
        spaced_name(cause.name)
        if cause.name in sized_above
        else f"{mechanism_with_size(final.get(cause.name, cause))}{'' if cause.name in named else ', not named'}"
        for cause in refitted.extension
    ]
    return f"Added to the three-dimensional heart: {'; '.join(extension)}."


def gain_subject(diagnosis: Diagnosis) -> str:
    """Return what the held-out error was computed with: " with mitral regurgitation", empty where nothing was added."""
    named = {cause.name for cause in diagnosis.mechanisms}
    if diagnosis.refitted and not {cause.name for cause in diagnosis.refitted.extension} <= named:
        return (
            f" with {added_name(diagnosis)} ({'candidate' if diagnosis.candidate else 'refitted'}, not named)"
        )
    if diagnosis.candidate and not (diagnosis.mechanisms or diagnosis.acting):
        return f" with {added_name(diagnosis)} (candidate, not named)"
    if added_name(diagnosis):
        return f" with {added_name(diagnosis)}"
    withdrawn = " and ".join(map(spaced_name, diagnosis.withdrawn))
    return f" with {withdrawn} (withdrawn)" if withdrawn and diagnosis.gain else ""


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
