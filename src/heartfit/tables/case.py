"""What one case under one setting gave: the record behind a row of every table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from heartfit.calibration.update import Posterior
from heartfit.observation.alignment import fit_curves
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.vector import cavity_indices, observe


@dataclass(frozen=True)
class CaseResult:
    """Numbers by name, SI.

    observed (what the update aimed at), noise (standard deviation), reference (Z at the prior X0), calibrated (Z at
    X_new): observations; prior, estimate: parameters, prior_sd and estimate_sd relative; units of the parameters;
    root_mean_square of each curve at the fitted time shift; guards: what was not observed and must still hold
    (EDV, wall volume loss, ...).
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
        """Signed relative error of the calibrated observations, in percent."""
        return relative_errors(self.calibrated, self.observed)

    def reference_errors(self) -> dict[str, float]:
        """The same at the prior."""
        return relative_errors(self.reference, self.observed)

    def floor(self) -> dict[str, float]:
        """Noise of each observation in percent of its value: no error below it means anything."""
        return {name: 100 * self.noise[name] / abs(value) for name, value in self.observed.items()}

    def scores(self) -> dict[str, float]:
        """z, the signed error over its floor: within one, the fit is as good as noise allows or fits the noise."""
        floor = self.floor()
        return {name: error / floor[name] for name, error in self.errors().items()}


def relative_errors(found: Mapping[str, float], true: Mapping[str, float]) -> dict[str, float]:
    """100 (found - true) / |true| for every name of `true`; NaN where nothing was found."""
    return {name: 100 * (found.get(name, float("nan")) - value) / abs(value) for name, value in true.items()}


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
    """The record of one case.

    identity: case, setting, fingerprint; curves: "measured", "reference" (prior X0), "calibrated" (X_new),
    time zero at the trigger, empty for a failed beat; features: the operators; units of the parameters;
    diagnostics of the calibrated beat, kept among the guards.
    """
    names = posterior.prior.names
    fit = {name: _fit(curves["measured"], curves[name], shift_limit) for name in ("reference", "calibrated")}
    return CaseResult(
        **identity,
        observed=dict(zip(posterior.observations, posterior.observed.tolist(), strict=True)),
        noise={each.name: each.noise for each in measurement.observations},
        reference=_observe(curves["reference"], features),
        calibrated=_observe(curves["calibrated"], features),
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
    """What no observation holds: errors in percent of EDV and ESV, peak pressures in Pa, per ventricle."""
    found: dict[str, float] = {}
    for side in ("lv", "rv"):
        if f"{side}_volume" in measured and f"{side}_volume" in simulated:
            errors = relative_errors(cavity_indices(simulated, side), cavity_indices(measured, side))
            found |= {f"{side}_{name}_error_percent": errors[name] for name in ("EDV", "ESV")}
        if f"{side}_pressure" in simulated:
            found[f"{side}_peak_pressure"] = float(simulated[f"{side}_pressure"].values.max())
    return found


def _observe(curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> dict[str, float]:
    return observe(curves, features) if curves else {}


def _fit(
    measured: Mapping[str, Curve], simulated: Mapping[str, Curve], limit: float
) -> tuple[float, dict[str, float]]:
    return fit_curves(measured, simulated, limit) if simulated else (float("nan"), {})
