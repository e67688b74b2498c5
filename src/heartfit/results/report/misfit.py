"""Misfit of the calibrated heart that the page shows: distance of its curves, and misfit of its targets and curves."""

from collections.abc import Iterator
from math import isfinite

from heartfit.discovery.refit.target import MeasuredCase
from heartfit.discovery.sphere_model.misfit import (
    CLEAR_MISFIT,
    deviation_of_means,
    largest_departure,
    phase_names,
)
from heartfit.discovery.sphere_model.recording import Samples
from heartfit.observation.beat import BeatPhases
from heartfit.observation.residual import residuals
from heartfit.results.errors import root_mean_square
from heartfit.results.figures import shift_curves
from heartfit.results.misfit_text import misfit_sentence
from heartfit.results.report.record import CaseRecord, Curves, FittedCase
from heartfit.results.text import CURVES

FLOWS = ("aortic_flow", "mitral_flow")
"""Curves that give the phases of a beat."""


def distance(case: CaseRecord, fit: FittedCase) -> str:
    """Return the root mean square of calibrated minus measured over noise for each curve; empty for a failed beat."""
    simulated = shift_curves(fit.calibrated, fit.shift)
    compared = {name: curve for name, curve in case.measured.items() if name in simulated}
    return ", ".join(
        f"{CURVES[residual.curve]} {root_mean_square(residual.score('calibrated')):.1f}"
        for residual in residuals(compared, {"calibrated": simulated}, case.noise)
    )


def calibrated_misfits(case: CaseRecord) -> list[str]:
    """Return the sentences on the misfit of each calibrated heart of a case, targets first."""
    return [sentence for setting, fit in case.fits.items() for sentence in _misfits(case, setting, fit)]


def _misfits(case: CaseRecord, setting: str, fit: FittedCase) -> Iterator[str]:
    model = f"the calibrated 3-D heart (setting {setting}, {len(fit.result.estimate)} free parameters)"
    if not fit.completed:
        yield f"The beat of {model} failed: nothing is compared."
        return
    yield _targets(model, fit)
    measured = MeasuredCase.from_curves(case.measured, case.noise)
    simulated = shift_curves(fit.calibrated, fit.shift)
    phases = _phases(simulated)
    for name, curve in measured.curves.items():
        if name in simulated:
            names = phase_names(curve.times, curve.period, phases)
            sd = deviation_of_means(measured.covariance({name: Samples.from_curve(curve)}), names)
            difference = simulated[name](curve.times) - curve.values
            yield misfit_sentence(largest_departure(name, difference, sd, names), model)


def _targets(model: str, fit: FittedCase) -> str:
    """Return the errors of the targets over their noise, or how many have one."""
    scores = {name: score for name, score in fit.result.scores().items() if isfinite(score)}
    missed = sum(abs(score) > CLEAR_MISFIT for score in scores.values())
    printed = ", ".join(f"{name} {score:+.1f}" for name, score in scores.items())
    errors = f": errors in sd of the noise {printed}" if printed else ""
    return (
        f"{model[0].upper()}{model[1:]} misses {missed} of the {len(scores)} targets of the calibration beyond the "
        f"noise{errors}."
    )


def _phases(curves: Curves) -> BeatPhases | None:
    """Return the phases of the beat; None without its flows, or where a valve never moves."""
    if not set(FLOWS) <= set(curves):
        return None
    try:
        return BeatPhases.from_curves(curves)
    except ValueError:
        return None
