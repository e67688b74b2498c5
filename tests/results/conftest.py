"""A cohort of linear hearts: their posteriors are the closed forms, without a beat."""

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import Posterior, calibrate
from heartfit.results.card import Card
from heartfit.results.case import Groups

OBSERVATIONS = ("V_min", "q_max", "q_min", "P_max", "dPdt_max", "dPdt_min")
SLOPES = {  # of ln Z by ln p, with the signs of a heart
    "sigma_0": (-0.6, 0.4, 0.5, 0.5, 0.7, 0.3),
    "mu": (0.0, -0.4, -0.3, -0.2, 0.0, 0.0),
    "c_1": (0.1, 0.2, -0.2, -0.4, -0.1, -0.1),
    "R_p": (0.3, -0.2, -0.2, 0.3, 0.0, 0.5),
    "k_RS": (0.0, 0.4, 0.0, 0.0, 0.2, 0.6),
    "k_ATP": (-0.2, 0.1, 0.3, 0.3, 0.6, 0.2),
    "tau": (0.0, 0.1, 0.1, -0.2, 0.0, -0.6),
}
NOISE = (0.03, 0.04, 0.04, 0.01, 0.04, 0.04)
MEANS = {"sigma_0": 300e3, "mu": 12e3, "c_1": 5.5e3, "R_p": 1.14e8, "k_RS": 35.0, "k_ATP": 12.0, "tau": 1.5}
TRUTHS = {
    "volunteer1": (1.1, 1.0, 1.1, 0.8),
    "volunteer2": (0.76, 1.0, 0.8, 1.15),
    "volunteer3": (0.95, 0.9, 1.0, 1.0),
    "volunteer4": (1.2, 1.1, 1.0, 0.9),
    "lbbb1": (0.6, 1.0, 1.05, 1.05),
    "lbbb2": (0.55, 1.0, 1.5, 1.1),
}
GROUPS = Groups(("volunteer1", "volunteer2", "volunteer3", "volunteer4"), ("real",), ("lbbb1", "lbbb2"))


def _posterior(
    prior: Gaussian, truth: Mapping[str, float], observed: Sequence[str], noise: np.ndarray | None
) -> Posterior:
    slopes = np.array([SLOPES[name] for name in prior.names])[:, : len(observed)]
    observe = {
        point.label: dict(zip(observed, np.exp((point.z - prior.mean) @ slopes), strict=True))
        for point in sigma_points(prior)
    }
    true = np.log([truth[name] for name in prior.names]) - prior.mean
    return calibrate(
        prior, list(observe.values()), dict(zip(observed, np.exp(true @ slopes), strict=True)), noise
    )


def card(case: str, setting: str = "physical") -> Card:
    """Four parameters from three observations of a volunteer, seven from six of a patient."""
    sick = case in GROUPS.patients
    names = list(SLOPES)[: 7 if sick else 4]
    observed = OBSERVATIONS[: 6 if sick else 3]
    prior = Gaussian.from_relative({name: MEANS[name] for name in names}, dict.fromkeys(names, 0.25))
    ratios = dict(zip(SLOPES, (*TRUTHS.get(case, (1.0,) * 4), 1.0, 1.0, 1.0), strict=True))
    truth = {name: 0.9 * MEANS[name] * ratio for name, ratio in ratios.items()}
    noise = np.diag(np.square(NOISE[: len(observed)]))
    noise_free, noise_aware = (
        _posterior(prior, truth, observed, None),
        _posterior(prior, truth, observed, noise),
    )
    return Card(case, setting, noise_free, noise_aware, truth if case in TRUTHS else {})


@pytest.fixture(scope="session")
def cohort() -> list[Card]:
    """Four volunteers, a measured heart and two patients."""
    return [card(case) for case in (*GROUPS.healthy, *GROUPS.patients)]


@pytest.fixture(scope="session")
def groups() -> Groups:
    """Groups of the cohort."""
    return GROUPS
