"""Two volunteers, a measured heart and a patient, as the records that the tables are made of."""

from heartfit.results.case import CaseResult


def result(name: str, sigma_0: float, observed: dict[str, float], setting: str = "physical") -> CaseResult:
    return CaseResult(
        case=name,
        setting=setting,
        fingerprint="abc",
        observed=observed,
        noise={key: 0.05 * abs(value) for key, value in observed.items()},
        reference={key: 1.5 * value for key, value in observed.items()},
        calibrated={key: (1.2 if key == "V_min" else 0.96) * value for key, value in observed.items()},
        prior={"sigma_0": 300e3, "K": 5e5},
        prior_sd={"sigma_0": 0.2, "K": 0.2},
        estimate={"sigma_0": sigma_0, "K": 6e5},
        estimate_sd={"sigma_0": 0.1, "K": 0.1},
        units={"sigma_0": "Pa", "K": "Pa"},
        failed_points=0,
        sigma_points=15,
    )


CASES = [
    result("v1", 290e3, {"V_min": 6e-5}),
    result("v2", 310e3, {"V_min": 7e-5}),
    result("real", 900e3, {"V_min": 7e-5}),
    result("lbbb1", 180e3, {"V_min": 1.2e-4, "dPdt_min": -1.4e6}),
]
