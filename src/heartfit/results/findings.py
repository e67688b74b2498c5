"""Our numbers for the claims of the paper, computed from the results of a study.

A source yields the findings of one claim: one per setting and group of hearts, virtual and measured ones apart.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
import pandas as pd

from heartfit.calibration.sensitivity import Sensitivity
from heartfit.observation.noise_model import NoiseModel
from heartfit.results.case import CaseResult, Groups
from heartfit.results.costs import calibration_time, number_of_updates
from heartfit.results.errors import PAPER
from heartfit.results.parameters import healthy_mean
from heartfit.results.text import printed_steps
from heartfit.study.need import Cost

SLOPES = ("q_max", "q_min")
VIRTUAL_HEARTS = "virtual hearts of known truth; the paper's are people"
PLANTED_PATIENTS = (
    "planted: the virtual patients were given ratios near the paper's, which an estimate can only recover"
)
BEAT_FAILED = "the calibrated beat failed"


@dataclass(frozen=True)
class Finding:
    """Our number for a claim: setting and hearts it is of, a reason where it decides nothing, and their long steps."""

    setting: str
    hearts: str
    value: float
    incomparable: str = ""
    long_steps: str = ""


@dataclass(frozen=True, eq=False)
class StudyResults:
    """Results that the claims are judged by.

    cases: under the settings that serve all hearts; costs: of all jobs; sensitivities: by setting; selection: its
    table, or empty; noise: model of the virtual images, or empty; planted_ratios: the hidden hearts
    have the ratios of the paper's Table 2.
    """

    cases: Sequence[CaseResult]
    groups: Groups
    costs: Sequence[Cost]
    sensitivities: Mapping[str, Sensitivity]
    selection: Sequence[pd.DataFrame]
    noise: Sequence[NoiseModel]
    planted_ratios: bool = True

    def under(self, setting: str) -> list[CaseResult]:
        """Return the cases under one setting."""
        return [case for case in self.cases if case.setting == setting]

    def hearts(self, kinds: str) -> dict[str, tuple[str, ...]]:
        """Return the names of the virtual and of the measured hearts, by label, without empty groups.

        kinds: "healthy", "patients" or "all".
        """
        groups = self.groups
        virtual, measured = {
            "healthy": (groups.volunteers, groups.measured),
            "patients": (groups.patients, groups.measured_patients),
            "all": (groups.virtual, groups.measured + groups.measured_patients),
        }[kinds]
        labelled = {f"{len(virtual)} virtual": virtual, ", ".join(measured): measured}
        return {label: names for label, names in labelled.items() if names}


Measure = Callable[[Sequence[CaseResult]], float]
Source = Callable[[StudyResults], Iterator[Finding]]


def over_hearts(
    kinds: str,
    measure: Measure,
    estimated: str = "",
    only: str = "",
    with_steps: bool = False,
    planted: str = "",
) -> Source:
    """Return the source of a measure of cases, per setting and group of hearts.

    kinds as in :meth:`StudyResults.hearts`; estimated: parameter that the cases must have; only: the one heart of the
    claim; with_steps: name the long steps of the cases, for a measure that rests on their estimates; planted: reason
    why virtual hearts decide nothing, if there is one.
    """

    def find(results: StudyResults) -> Iterator[Finding]:
        for setting in dict.fromkeys(case.setting for case in results.cases):
            for hearts, names in results.hearts(kinds).items():
                wanted = [name for name in names if only in ("", name)]
                group = [case for case in results.under(setting) if case.case in wanted]
                if group and all(not estimated or estimated in case.estimate for case in group):
                    value = measure(group)
                    virtual = results.groups.virtual
                    reason = planted if all(name in virtual for name in wanted) else ""
                    reason = reason if isfinite(value) else BEAT_FAILED
                    yield Finding(
                        setting, only or hearts, value, reason, _long_steps(group) if with_steps else ""
                    )

    return find


def _long_steps(cases: Sequence[CaseResult]) -> str:
    """Return the long steps of all cases, such as "volunteer6: sigma_0 +2.7"."""
    named = {case.case: printed_steps(case.long_steps()) for case in cases}
    return "; ".join(f"{case}: {steps}" for case, steps in named.items() if steps)


def errors_of(summary: Callable[[Sequence[float]], float], *observations: str) -> Measure:
    """Return the measure: summary of the unsigned errors [%] of these observations, or of all.

    NaN if no beat completed.
    """

    def measure(cases: Sequence[CaseResult]) -> float:
        signed = [(name, error) for case in cases for name, error in case.errors().items()]
        errors = [
            abs(error)
            for name, error in signed
            if isfinite(error) and (not observations or name in observations)
        ]
        return float(summary(errors)) if errors else float("nan")

    return measure


def estimates_of(
    name: str,
    summary: Callable[[Sequence[float]], float],
    kinds: str = "healthy",
    only: str = "",
    planted: str = "",
) -> Source:
    """Return the source of a summary of one parameter's estimates, SI; ``planted`` as in :func:`over_hearts`."""
    return over_hearts(
        kinds, lambda cases: summary([case.estimate[name] for case in cases]), name, only, True, planted
    )


def over_healthy_mean(names: Sequence[str], only: str = "") -> Source:
    """Return the source of the largest estimate of the patients over the mean of the virtual volunteers.

    Virtual patients decide nothing: their ratios were planted.
    names: the parameter, or those that may stand for it, of which the first that all these hearts estimate counts.
    """

    def find(results: StudyResults) -> Iterator[Finding]:
        for setting in dict.fromkeys(case.setting for case in results.cases):
            mean = healthy_mean(results.under(setting), results.groups)
            name = next((name for name in names if name in mean), None)
            if name:
                largest = estimates_of(name, max, "patients", only, PLANTED_PATIENTS)
                of_setting = (finding for finding in largest(results) if finding.setting == setting)
                yield from (
                    Finding(
                        setting,
                        f"{finding.hearts}, {name}",
                        finding.value / mean[name],
                        finding.incomparable,
                        finding.long_steps,
                    )
                    for finding in of_setting
                )

    return find


def number_of_hearts(kinds: str) -> Source:
    """Return the source of the number of virtual hearts, which are not the paper's people, and of measured ones."""

    def find(results: StudyResults) -> Iterator[Finding]:
        of_kind = results.hearts(kinds)
        virtual = [name for names in of_kind.values() for name in names if name in results.groups.virtual]
        yield Finding("", "virtual", len(virtual), VIRTUAL_HEARTS)
        yield Finding("", "measured", sum(map(len, of_kind.values())) - len(virtual))

    return find


def number_of_priors(cases: Sequence[CaseResult]) -> float:
    """Return the number of different priors of the parameters that all cases share."""
    shared = [name for name in cases[0].prior if all(name in case.prior for case in cases)]
    return len({tuple((case.prior[name], case.prior_sd[name]) for name in shared) for case in cases})


def from_costs(measure: Callable[[Sequence[Cost], str, str], float]) -> Source:
    """Return the source of the largest value over the hearts of a measure of the jobs of a case and a setting."""

    def find(results: StudyResults) -> Iterator[Finding]:
        yield from over_hearts(
            "all", lambda cases: max(measure(results.costs, case.case, case.setting) for case in cases)
        )(results)

    return find


def minutes(costs: Sequence[Cost], case: str, setting: str) -> float:
    """Return the time of a calibration [min]."""
    return calibration_time(costs, case, setting) / 60.0


def updates(costs: Sequence[Cost], case: str, setting: str) -> float:
    """Return the number of updates of a calibration."""
    return number_of_updates(costs, case, setting)


def analysed_parameters(results: StudyResults) -> Iterator[Finding]:
    """Yield the number of parameters of the sensitivity analysis by setting."""
    for setting, sensitivity in results.sensitivities.items():
        yield Finding(setting, "", len(sensitivity.parameters))


def selected(observed: str) -> Source:
    """Return the source of the number of the paper's parameters that the decomposition selects under our model."""

    def find(results: StudyResults) -> Iterator[Finding]:
        rows = [
            row
            for table in results.selection
            for row in table.to_dict("records")
            if row["observed"] == observed
        ]
        sets = {(row["setting"], row["chosen by"]): {*row["parameters"].split(", ")} for row in rows}
        for setting, chooser in sets:
            if chooser == PAPER:
                yield Finding(setting, "", len(sets[setting, "rule"] & sets[setting, PAPER]))

    return find


def registration_error(*names: str) -> Source:
    """Return the source of the mean unsigned error [%] of observations after registration, by the noise model."""

    def find(results: StudyResults) -> Iterator[Finding]:
        for noise in results.noise:
            mean = 100.0 * float(np.mean([noise.mean_unsigned_error(name) for name in names]))
            yield Finding("", f"{noise.sequences} image sequences", mean)

    return find


def registration_over_calibration(results: StudyResults) -> Iterator[Finding]:
    """Yield the error of the slopes after registration over that of the volunteers' slopes after calibration."""
    for registered in registration_error(*SLOPES)(results):
        for one in over_hearts("healthy", errors_of(np.mean, *SLOPES), with_steps=True)(results):
            yield Finding(
                one.setting, one.hearts, registered.value / one.value, one.incomparable, one.long_steps
            )
