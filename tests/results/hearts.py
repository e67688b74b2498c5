"""Calibrated hearts of a small study, as plain numbers."""

from collections.abc import Mapping

from heartfit.results.case import CaseResult

OBSERVED = {"V_min": 72e-6, "q_max": 474e-6, "q_min": -520e-6}
WITH_PRESSURE = OBSERVED | {"P_max": 15e3, "dPdt_max": 1.4e6, "dPdt_min": -1.3e6}
PRIOR = {"sigma_0": 300e3, "mu": 15e3, "K": 500e3, "R_p": 110e6, "k_RS": 30.0, "k_ATP": 12.0, "c_1": 5e3}
UNITS = {
    "sigma_0": "Pa",
    "mu": "Pa.s",
    "K": "Pa",
    "R_p": "Pa.s/m^3",
    "k_RS": "1/s",
    "k_ATP": "1/s",
    "c_1": "Pa",
}


def calibrated(
    case: str,
    setting: str = "locking",
    errors: float | Mapping[str, float] = 2.0,
    ratios: Mapping[str, float] | None = None,
    pressure: bool = False,
) -> CaseResult:
    """A heart whose estimates are the prior times ``ratios``; errors [%] of all observations, or by name."""
    observed = WITH_PRESSURE if pressure else OBSERVED
    names = list(PRIOR)[: 7 if pressure else 4]
    if setting == "physical":
        names = ["c_1" if name == "K" else "K" if name == "c_1" else name for name in names]
    percent = errors if isinstance(errors, Mapping) else dict.fromkeys(observed, errors)
    return CaseResult(
        case=case,
        setting=setting,
        fingerprint="abc",
        observed=observed,
        noise=dict.fromkeys(observed, 1e-6),
        reference=dict(observed),
        calibrated={name: value * (1 + percent[name] / 100) for name, value in observed.items()},
        prior={name: PRIOR[name] for name in names},
        prior_sd=dict.fromkeys(names, 0.2),
        estimate={name: PRIOR[name] * (ratios or {}).get(name, 1.0) for name in names},
        estimate_sd=dict.fromkeys(names, 0.1),
        units={name: UNITS[name] for name in names},
        failed_points=0,
        sigma_points=2 * len(names) + 1,
    )
