"""Misfit of the simulation of each refitted case, its cause, and the gain of the model by it.

A sealed heart has an answer to each finding; a measured heart has none.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.sphere_model.cause import Cause, CurveFit, Diagnosis, Gain
from heartfit.discovery.sphere_model.misfit import Departure, departures
from heartfit.results.errors import root_mean_square
from heartfit.results.found import HIDDEN, NOTHING, SAID
from heartfit.results.misfit_text import mean_misfit
from heartfit.results.text import (
    AMPLITUDE_UNITS,
    CURVES,
    RenderedTable,
    printed_ratio,
    spaced_name,
    to_latex,
    to_markdown,
)
from heartfit.results.verdict_text import candidate_names
from heartfit.synthetic.campaign import Effect

NAN = float("nan")
UNTOLD = ("K",)
"""Parameters without a true value: K acts through the locking of linear tetrahedra alone."""


@dataclass(frozen=True, eq=False)
class DiscoveryResult:
    """Search and refit of one case under one setting, and the answer that only an evaluation may know.

    searched, proved: diagnoses on the sphere, and after the refits in three dimensions; hidden: effects of a sealed
    heart, None for a measured one; truth: parameters of a virtual heart [SI], empty for a measured one.
    """

    case: str
    setting: str
    searched: Diagnosis
    proved: Diagnosis
    hidden: Sequence[Effect] | None = None
    truth: Mapping[str, float] | None = None

    def log_errors(self, estimate: Mapping[str, float]) -> dict[str, float]:
        """Return ln(estimate / truth) of each parameter that has a true value."""
        truth = self.truth or {}
        return {
            name: float(np.log(value / truth[name]))
            for name, value in estimate.items()
            if name in truth and name not in UNTOLD
        }


@dataclass(frozen=True)
class Entry:
    """One finding of a case: its name, a value with an interval where it has one, and the printed text."""

    quantity: str
    text: str
    value: float = NAN
    low: float = NAN
    high: float = NAN


def discovery_table(results: Sequence[DiscoveryResult]) -> RenderedTable:
    """Return the findings: as CSV one row for each case and finding, printed with the cases as columns."""
    rows = [
        {"case": result.case, "setting": result.setting, **vars(entry)}
        for result in results
        for entry in _entries(result)
    ]
    printed = printed_findings(results)
    return RenderedTable(pd.DataFrame(rows), f"{to_markdown(printed)}\n{NOTE}\n", to_latex(printed))


def printed_findings(results: Sequence[DiscoveryResult]) -> pd.DataFrame:
    """Return the findings as text, one row for each finding and one column for each case and setting."""
    texts = {
        f"{result.case}, {result.setting}": {entry.quantity: entry.text for entry in _entries(result)}
        for result in results
    }
    names = list(dict.fromkeys(name for listed in texts.values() for name in listed))
    columns = {heading: [listed.get(name, "") for name in names] for heading, listed in texts.items()}
    return pd.DataFrame({"finding": names} | columns)


NOTE = (
    "Misfit: of the refitted three-dimensional heart without an added mechanism, on average over the phase in which it "
    "is clearest, ± the noise of this average; sd: misfit over noise. The search on the sphere and "
    "the refits use one half of the samples; the error ratio, with the mechanism over without it, is that of the other "
    "half and of the strain, to which nothing was fitted. Chi-squared of the refits: of all samples of a curve, of its "
    "degrees of freedom, with the probability p that a correct model is further off. The size from all samples is one "
    "linear step from the refit, once the other half has judged. K has no true value. Refits are coarse where the "
    "configuration has `discovery.coarse`."
)


def _entries(result: DiscoveryResult) -> Iterator[Entry]:
    searched, proved = result.searched, result.proved
    if result.hidden is not None:
        yield Entry(HIDDEN, "; ".join(map(_hidden_effect, result.hidden)) or NOTHING)
    yield from map(_departure, departures(proved))
    yield from (_fit(fit, "without a mechanism") for fit in proved.fits)
    yield Entry("verdict of the search", _verdict(searched))
    yield _factor_of_the_search(searched)
    yield _number("threshold of a detection", searched.threshold)
    if searched.candidate:
        yield _candidate_beside_process(searched.candidate.beside_process)
    yield Entry(SAID, _verdict(proved))
    if proved.refitted:
        yield from _sizes(proved.refitted.extension, "fitted half of the samples")
        yield from _sizes(proved.refitted.from_all_samples, "all samples")
        yield from _hidden_sizes(proved.refitted.extension, result.hidden or ())
        yield _number("ln Bayes factor of the refits", proved.refitted.ln_bayes_factor)
        yield Entry("both refits converged", "yes" if proved.refitted.converged else "no")
        yield from (_fit(fit, "with the mechanism") for fit in proved.refitted.fits)
    yield from map(_gain, proved.gain)
    yield from _parameters(result)
    yield Entry("simulated beats", f"{float(f'{proved.simulations:.2g}'):.0f}", proved.simulations)


def _number(quantity: str, value: float) -> Entry:
    return Entry(quantity, f"{value:.1f}", value)


def _factor_of_the_search(searched: Diagnosis) -> Entry:
    """Return the ln Bayes factor of what the search names, else the largest one, with its owner if it is detected.

    All mechanisms of a pair have the factor of the pair; of a group the best one counts.
    """
    quantity = "ln Bayes factor of the search"
    factors = {spaced_name(cause.name): cause.ln_bayes_factor for cause in searched.mechanisms}
    ranked = factors or {spaced_name(name): value for name, value in searched.ranking.items()}
    if not ranked:
        return Entry(quantity, "nothing tried")
    owner, factor = max(ranked.items(), key=lambda entry: entry[1])
    if factor < searched.threshold:
        return Entry(quantity, f"at most {_held(factor)}", factor)
    if searched.verdict == "two":
        owner = " and ".join(factors)
    return Entry(quantity, f"{_held(factor)} ({owner.replace('unknown', 'a Gaussian process')})", factor)


def _held(factor: float) -> str:
    """Return the printed ln Bayes factor of a search: rounding moves the decimal of a large one."""
    return f"{factor:.0f}" if abs(factor) >= 10.0 else f"{factor:.1f}"


def _candidate_beside_process(beside: BesideProcess) -> Entry:
    side = "above" if beside.over >= 0.0 else "below"
    text = (
        f"{beside.gain:.1f}, {abs(beside.over):.1f} {side} a Gaussian process; "
        f"a name needs {beside.required:g} above"
    )
    return Entry("ln Bayes factor of the candidate", text, beside.gain)


def _hidden_effect(effect: Effect) -> str:
    return f"{spaced_name(effect.name)}, {_amplitude(effect.amplitude, effect.unit)} ({effect.scales:.1f} scales)"


def _amplitude(value: float, unit: str) -> str:
    printed, factor = AMPLITUDE_UNITS.get(unit, (unit, 1.0))
    return f"{factor * value:.3g} {printed}".strip()


def _verdict(diagnosis: Diagnosis) -> str:
    names = " and ".join(spaced_name(cause.name) for cause in diagnosis.mechanisms)
    withdrawn = ", ".join(map(spaced_name, diagnosis.withdrawn))
    remarks = [f"withdrawn: {withdrawn}"] if withdrawn else []
    remarks += [f"candidate, not named: {candidate_names(diagnosis)}"] if diagnosis.candidate else []
    remark = f" ({'; '.join(remarks)})" if remarks else ""
    return f"{diagnosis.verdict}{f': {names}' if names else ''}{remark}"


def _departure(departure: Departure) -> Entry:
    text = f"{mean_misfit(departure)}: {abs(departure.deviations):.1f} sd"
    return Entry(f"misfit: {CURVES.get(departure.curve, departure.curve)}", text, departure.deviations)


def _fit(fit: CurveFit, model: str) -> Entry:
    """Return the chi-squared of a curve; its value is the probability of a larger one, which a correct model meets."""
    curve = CURVES.get(fit.curve, fit.curve)
    text = f"{fit.chi_squared:.1f} of {fit.freedom:.1f}, p = {fit.p:.2g}"
    return Entry(f"chi-squared: {curve}, {model}", text, fit.p)


def _size(name: str, unit: str) -> tuple[str, float]:
    """Return the heading of a mechanism's size, and the factor from SI to the printed unit."""
    printed, factor = AMPLITUDE_UNITS.get(unit, (unit, 1.0))
    return f"size of {spaced_name(name)}{f' ({printed})' if printed else ''}", factor


def _sizes(causes: Sequence[Cause], source: str) -> Iterator[Entry]:
    for cause in causes:
        heading, factor = _size(cause.name, cause.unit)
        value, low, high = (factor * amplitude for amplitude in (cause.amplitude, *cause.interval))
        yield Entry(f"{heading}, {source}", f"{value:.3g} ({low:.3g} to {high:.3g})", value, low, high)


def _hidden_sizes(causes: Sequence[Cause], hidden: Sequence[Effect]) -> Iterator[Entry]:
    names = [cause.name for cause in causes]
    for effect in hidden:
        if effect.name in names:
            heading, factor = _size(effect.name, effect.unit)
            yield Entry(f"{heading}, hidden", f"{factor * effect.amplitude:.3g}", factor * effect.amplitude)


def _gain(gain: Gain) -> Entry:
    curve = CURVES.get(gain.curve, gain.curve)
    return Entry(
        f"error ratio: {curve}, {gain.on}",
        printed_ratio(gain.ratio, gain.interval),
        gain.ratio,
        *gain.interval,
    )


def _parameters(result: DiscoveryResult) -> Iterator[Entry]:
    refitted = result.proved.refitted
    if refitted is None:
        return
    for name, before in refitted.none.items():
        change = 100.0 * (refitted.extended[name] / before - 1.0)
        yield Entry(f"change of {name} (%)", f"{change:+.0f}", change)
    errors = [result.log_errors(estimate) for estimate in (refitted.none, refitted.extended)]
    for name in errors[0]:
        before, after = (100.0 * (np.exp(error[name]) - 1.0) for error in errors)
        yield Entry(f"error of {name} (%), without and with", f"{before:+.0f}, {after:+.0f}", after, before)
    if errors[0]:
        before, after = (100.0 * float(root_mean_square(list(error.values()))) for error in errors)
        text = f"{before:.0f}, {after:.0f}"
        yield Entry("bias of the parameters (%), without and with", text, after, before)
