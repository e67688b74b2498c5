"""What one case under one setting gave: the record behind a row of every table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from heartfit.calibration.update import Posterior
from heartfit.observation.alignment import fit_curves
from heartfit.observation.curve import Curve
from heartfit.observation.noise import Observation


@dataclass(frozen=True)
class CaseResult:
    """Numbers by name, SI.

    observed, noise (standard deviation), reference (Z at the prior X0), calibrated (Z at X_new):
    observations; prior, estimate: parameters, prior_sd and estimate_sd relative; units of the parameters;
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


def relative_errors(found: Mapping[str, float], true: Mapping[str, float]) -> dict[str, float]:
    """100 (found - true) / |true| for every name of `true`; NaN where nothing was found."""
    return {name: 100 * (found.get(name, float("nan")) - value) / abs(value) for name, value in true.items()}


def summarise(
    identity: Mapping[str, str],
    posterior: Posterior,
    observations: Sequence[Observation],
    predicted: Mapping[str, Mapping[str, float]],
    curves: Mapping[str, Mapping[str, Curve]],
    units: Mapping[str, str],
    points: Sequence[bool],
    guards: Mapping[str, float],
    shift_limit: float = 0.1,
) -> CaseResult:
    """The record of one case.

    identity: case, setting, fingerprint; predicted: observations of "reference" and "calibrated"; curves:
    "measured", "reference", "calibrated", time zero at the trigger; units of the parameters; points: which
    sigma points completed.
    """
    names = posterior.prior.names
    fits = {
        name: _fit(curves["measured"], curves.get(name, {}), shift_limit)
        for name in ("reference", "calibrated")
    }
    return CaseResult(
        **identity,
        observed={o.name: o.value for o in observations},
        noise={o.name: o.noise for o in observations},
        reference=predicted["reference"],
        calibrated=predicted["calibrated"],
        prior=posterior.prior.physical(),
        prior_sd=dict(zip(names, posterior.prior.sd.tolist(), strict=True)),
        estimate=posterior.estimate.physical(),
        estimate_sd=dict(zip(names, posterior.estimate.sd.tolist(), strict=True)),
        units={name: units[name] for name in names},
        failed_points=len(points) - sum(points),
        sigma_points=len(points),
        root_mean_square=fits["calibrated"][1],
        reference_root_mean_square=fits["reference"][1],
        shift=fits["calibrated"][0],
        guards=guards,
        notes=posterior.notes,
    )


def _fit(
    measured: Mapping[str, Curve], simulated: Mapping[str, Curve], limit: float
) -> tuple[float, dict[str, float]]:
    return fit_curves(measured, simulated, limit) if simulated else (float("nan"), {})
