"""Sentences on what a simulation gets wrong, each with the model that it speaks of."""

from collections.abc import Mapping, Sequence

from heartfit.discovery.sphere_model.cause import CurveFit, Diagnosis
from heartfit.discovery.sphere_model.misfit import Departure, departures
from heartfit.results.text import CURVES, printed_curve_unit, spaced_name, two_digits

FREE_FUNCTION = "a free function at the best place"
MODELS = {"sphere": "the sphere of the search", "3-D heart": "the refitted 3-D heart"}
"""Words for the model whose curves a diagnosis shows."""


def added_name(diagnosis: Diagnosis) -> str:
    """Return what the second simulation of the curves adds: the mechanisms that were fitted, or a free function.

    Of a group the best one. Empty where nothing was added.
    """
    if diagnosis.acting:
        return FREE_FUNCTION
    candidate = diagnosis.candidate.causes if diagnosis.candidate else ()
    causes = diagnosis.refitted.extension if diagnosis.refitted else diagnosis.mechanisms or candidate
    fitted = causes[:1] if diagnosis.verdict == "group" else causes
    return " and ".join(spaced_name(cause.name) for cause in fitted)


def model_name(diagnosis: Diagnosis, extended: bool = False) -> str:
    """Return the model of the curves, such as "the sphere of the search (23 free parameters, no mechanism)"."""
    added = f"with {added_name(diagnosis)}" if extended else "no mechanism"
    free = f"{diagnosis.free_parameters} free parameters" if diagnosis.free_parameters else ""
    return f"{MODELS[diagnosis.model]} ({', '.join(filter(None, [free, added]))})"


def misfit_sentences(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Return one sentence per curve on the simulation without a cause, then on that with it where there is one."""
    models = (False, True) if added_name(diagnosis) else (False,)
    return tuple(
        misfit_sentence(
            departure, model_name(diagnosis, extended), _fits(diagnosis, extended).get(departure.curve)
        )
        for extended in models
        for departure in departures(diagnosis, extended)
    )


def _fits(diagnosis: Diagnosis, extended: bool) -> Mapping[str, CurveFit]:
    """Return the chi-squared of the curves of a model, by curve; empty where none was computed."""
    fits = (diagnosis.refitted.fits if diagnosis.refitted else ()) if extended else diagnosis.fits
    return {fit.curve: fit for fit in fits}


def misfit_sentence(departure: Departure, model: str, fit: CurveFit | None = None) -> str:
    """Return what a model gets wrong in a curve on average over a phase, and the noise of that average.

    "The sphere of the search (...) gives the aortic pressure 0.8 ± 0.2 kPa too low in ejection (4.0 sd of the noise,
    12 samples)." fit: chi-squared of all samples about this model.
    """
    curve = CURVES.get(departure.curve, departure.curve)
    subject = f"{model[0].upper()}{model[1:]}"
    of_noise = f"{abs(departure.deviations):.1f} sd of the noise, {_samples(departure.samples)}"
    whole = (
        f"; over the beat chi-squared is {fit.chi_squared:.1f} of {fit.freedom:.1f} degrees of freedom, p = {fit.p:.2g}"
        if fit
        else ""
    )
    if departure.clear:
        return f"{subject} gives the {curve} {mean_misfit(departure)} ({of_noise}){whole}."
    largest = f"at most {mean_misfit(departure)} ({of_noise}){whole}."
    if fit is None or fit.within_noise:
        return (
            f"{subject} leaves no misfit of the {curve} beyond the noise in the mean of any phase: {largest}"
        )
    return (
        f"{subject} misses the {curve} by more than its noise, though not in the mean of a phase: {largest}"
    )


def mean_misfit(departure: Departure) -> str:
    """Return "0.8 ± 0.2 kPa too low in ejection", the mean over the phase."""
    unit, size_of_unit = printed_curve_unit(departure.curve)
    size, sd = (two_digits(value / size_of_unit) for value in (abs(departure.size), departure.sd))
    return f"{size} ± {sd} {unit} {direction_and_phase(departure)}"


def direction_and_phase(departure: Departure) -> str:
    """Return "too low in ejection"."""
    return f"{'too high' if departure.size > 0.0 else 'too low'} in {departure.phase}"


def _samples(number: int) -> str:
    return "1 sample" if number == 1 else f"mean of {number} samples"


def misfit_remarks(diagnosis: Diagnosis) -> list[str]:
    """Return how the misfit and the verdict go together where a reader may see a contradiction."""
    misfit = any(
        departure.clear for departure in departures(diagnosis) if departure.curve not in diagnosis.unsearched
    )
    if diagnosis.mechanisms and not misfit:
        return [
            "Free parameters can take the place of a mechanism: its evidence also counts how far from their usual "
            "values they go without it."
        ]
    if misfit and diagnosis.verdict in ("none", "model", "insufficient"):
        return ["This misfit stays unexplained: nothing that was tried explains it with enough evidence."]
    return []


def unsearched_sentences(diagnosis: Diagnosis) -> list[str]:
    """Return one sentence per recorded curve that the search left out, with the reason."""
    return [
        f"The {CURVES[name]} was not searched, because {reason}."
        for name, reason in diagnosis.unsearched.items()
    ]


def misfit_lines(diagnosis: Diagnosis) -> Sequence[str]:
    """Return all sentences on the misfit in reading order."""
    return [
        *misfit_sentences(diagnosis),
        *unsearched_sentences(diagnosis),
        *reading_sentences(diagnosis),
        *misfit_remarks(diagnosis),
    ]


def reading_sentences(diagnosis: Diagnosis) -> list[str]:
    """Return one sentence per curve that was read twice: its noise, and what the two readings share."""
    return [
        f"The {CURVES[name]} was read twice. The difference of both readings gives a noise of {deviation / size:.1f} "
        f"{unit}, in which an error that they share, as of the length of the cavity, does not show."
        for name, deviation in diagnosis.read_twice.items()
        for unit, size in [printed_curve_unit(name)]
    ]
