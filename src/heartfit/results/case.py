"""Results of a case under a setting, groups of cases, and the check that one code computed them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import log
from types import MappingProxyType

from heartfit.calibration.update import Posterior, long_steps
from heartfit.observation.curve import Curve, fit_curves
from heartfit.observation.measurement import Measurement
from heartfit.observation.operator import CurveFeatures, cavity_indices, observe

DILATED = "lbbb2"
"""Name of the patient with dilated cardiomyopathy, LBBB case 2 of the paper."""


@dataclass(frozen=True)
class Groups:
    """Case names by group: virtual volunteers, measured (healthy) hearts, virtual patients, measured patients."""

    volunteers: tuple[str, ...]
    measured: tuple[str, ...] = ()
    patients: tuple[str, ...] = ()
    measured_patients: tuple[str, ...] = ()

    @property
    def healthy(self) -> tuple[str, ...]:
        """Return the cases that correspond to the healthy volunteers of the paper."""
        return self.volunteers + self.measured

    @property
    def diseased(self) -> tuple[str, ...]:
        """Return the cases that correspond to the patients of the paper."""
        return self.patients + self.measured_patients

    @property
    def virtual(self) -> tuple[str, ...]:
        """Return the cases with a known truth."""
        return self.volunteers + self.patients

    @property
    def means(self) -> dict[str, tuple[str, ...]]:
        """Return the groups of healthy hearts that have a mean, by the suffix of its name."""
        several = bool(self.measured) and len(self.healthy) > 1
        with_measured = {f" with {', '.join(self.measured)}": self.healthy} if several else {}
        return ({"": self.volunteers} if self.volunteers else {}) | with_measured


@dataclass(frozen=True)
class Origin:
    """Study behind the numbers: its folder of results, groups, and the period [s] and seed of each case."""

    results: str
    groups: Groups
    periods: Mapping[str, float]
    seeds: Mapping[str, int | None]


@dataclass(frozen=True)
class CaseResult:
    """Result of one case under one setting: numbers by name, SI.

    observed (target of the update), noise (standard deviation), reference (Z at the prior X0), calibrated (Z at
    X_new): observations; prior, estimate: parameters, prior_sd and estimate_sd relative; units of the parameters;
    root_mean_square of each curve at the fitted time shift; guards: quantities outside the observations that must stay
    plausible (EDV, wall volume loss, ...).
    """

    case: str
    setting: str
    fingerprint: str
    observed: Mapping[str, float]
    noise: Mapping[str, float]
    reference: Mapping[str, float]
    calibrated: Mapping[str, float]
    prior: Mapping[str, float]
    prior_sd: Mapping[str, float]
    estimate: Mapping[str, float]
    estimate_sd: Mapping[str, float]
    units: Mapping[str, str]
    failed_points: int
    sigma_points: int
    root_mean_square: Mapping[str, float] = field(default_factory=dict)
    reference_root_mean_square: Mapping[str, float] = field(default_factory=dict)
    shift: float = 0.0
    guards: Mapping[str, float] = field(default_factory=dict)
    notes: Sequence[str] = ()

    def errors(self) -> dict[str, float]:
        """Return the signed relative error of each calibrated observation [%]."""
        return relative_errors(self.calibrated, self.observed)

    def reference_errors(self) -> dict[str, float]:
        """Return the signed relative error of each observation at the prior [%]."""
        return relative_errors(self.reference, self.observed)

    def floor(self) -> dict[str, float]:
        """Return the noise of each observation in percent of its value; smaller errors have no meaning."""
        return {name: 100 * self.noise[name] / abs(value) for name, value in self.observed.items()}

    def steps(self) -> dict[str, float]:
        """Return the distance of each estimate from the prior's mean [prior standard deviations]."""
        return {
            name: log(value / self.prior[name]) / self.prior_sd[name] for name, value in self.estimate.items()
        }

    def long_steps(self) -> dict[str, float]:
        """Return the steps that are too long for one straight step, see `heartfit.calibration.update`."""
        steps = self.steps()
        return long_steps(list(steps), list(steps.values()))

    def scores(self) -> dict[str, float]:
        """Return z, the signed error over its floor; |z| < 1 is as good as noise allows, or fits the noise."""
        floor = self.floor()
        return {name: error / floor[name] for name, error in self.errors().items()}


def relative_errors(values: Mapping[str, float], true: Mapping[str, float]) -> dict[str, float]:
    """Return 100 (value - true) / |true| for each name of ``true``; NaN for a missing value."""
    return {name: 100 * (values.get(name, float("nan")) - value) / abs(value) for name, value in true.items()}


def summarise(
    identity: Mapping[str, str],
    posterior: Posterior,
    measurement: Measurement,
    curves: Mapping[str, Mapping[str, Curve]],
    features: Mapping[str, CurveFeatures],
    units: Mapping[str, str],
    diagnostics: Mapping[str, float] = MappingProxyType({}),
    shift_limit: float = 0.1,
) -> CaseResult:
    """Return the result of one case.

    identity: case, setting, fingerprint; curves: "measured", "reference" (prior X0), "calibrated" (X_new),
    time zero at the trigger, empty for a failed beat; features: the operators; units of the parameters;
    diagnostics of the calibrated beat, kept among the guards.
    """
    names = posterior.prior.names
    fit = {
        name: _fit_shift(curves["measured"], curves[name], shift_limit)
        for name in ("reference", "calibrated")
    }
    return CaseResult(
        **identity,
        observed=dict(zip(posterior.observations, posterior.observed.tolist(), strict=True)),
        noise={observation.name: observation.noise for observation in measurement.observations},
        reference=_observe_completed(curves["reference"], features),
        calibrated=_observe_completed(curves["calibrated"], features),
        prior=posterior.prior.physical(),
        prior_sd=dict(zip(names, posterior.prior.sd.tolist(), strict=True)),
        estimate=posterior.estimate.physical(),
        estimate_sd=dict(zip(names, posterior.estimate.sd.tolist(), strict=True)),
        units={name: units[name] for name in names},
        failed_points=len(posterior.failed),
        sigma_points=2 * len(names) + 1,
        root_mean_square=fit["calibrated"][1],
        reference_root_mean_square=fit["reference"][1],
        shift=fit["calibrated"][0],
        guards={**guards(curves["measured"], curves["calibrated"]), **diagnostics},
        notes=posterior.notes,
    )


def guards(measured: Mapping[str, Curve], simulated: Mapping[str, Curve]) -> dict[str, float]:
    """Return quantities outside the observations: errors of EDV and ESV [%], peak pressures [Pa], per ventricle."""
    values: dict[str, float] = {}
    for side in ("lv", "rv"):
        if f"{side}_volume" in measured and f"{side}_volume" in simulated:
            errors = relative_errors(cavity_indices(simulated, side), cavity_indices(measured, side))
            values |= {f"{side}_{name}_error_percent": errors[name] for name in ("EDV", "ESV")}
        if f"{side}_pressure" in simulated:
            values[f"{side}_peak_pressure"] = float(simulated[f"{side}_pressure"].values.max())
    return values


def _observe_completed(
    curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]
) -> dict[str, float]:
    return observe(curves, features) if curves else {}


def _fit_shift(
    measured: Mapping[str, Curve], simulated: Mapping[str, Curve], limit: float
) -> tuple[float, dict[str, float]]:
    return fit_curves(measured, simulated, limit) if simulated else (float("nan"), {})


class FingerprintMismatchError(ValueError):
    """Results of different code in one table."""


def require_one_fingerprint(cases: Sequence[CaseResult]) -> str:
    """Return the fingerprint of all cases; raises FingerprintMismatchError with the cases of each fingerprint."""
    if not cases:
        raise ValueError("table: no cases; expected at least one result")
    owners: dict[str, list[str]] = {}
    for case in cases:
        owners.setdefault(case.fingerprint, []).append(f"{case.case}/{case.setting}")
    if len(owners) > 1:
        listed = "; ".join(f"{fingerprint}: {', '.join(names)}" for fingerprint, names in owners.items())
        raise FingerprintMismatchError(
            f"table: results of different code ({listed}): run the study again for the older ones"
        )
    return cases[0].fingerprint
