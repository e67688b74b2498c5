r"""The mechanisms that a search tried as a model space of PEtab Select, each model with its criteria.

Every model that was fitted is a subspace of its own: a column for each mechanism, "estimate" where the model has it
and 0 where it has not. PEtab Select knows no evidence. A marginal likelihood is the likelihood of a model of which
every parameter has been integrated out, so what the search decides by is given as a negative ln likelihood,

.. math:: \mathrm{NLLH} = -\ln Z - \ln \pi_k, \qquad -\ln \pi_0 = 0, \quad -\ln \pi_1 = d, \quad -\ln \pi_2 = d + s,

where the thresholds of detection d and of a second effect s stand as odds that a model must overcome. Beside it,
NLLH, AIC and BIC at the most probable parameters, which the priors hold: these are not maximum likelihoods.
"""

from collections.abc import Iterable, Mapping, Sequence
from math import log
from typing import Any

from heartfit.diagnosis.cause import Tried
from heartfit.diagnosis.free import FREE
from heartfit.discovery.rules import RULES

NONE = "none"
BASE = "petab/problem.yaml"
"""The PEtab problem below all models, relative to the model space."""
PROBLEM = {
    "format_version": "1.0.0",
    "criterion": "NLLH",
    "method": "forward",
    "model_space_files": ["model_space.tsv"],
}


def mechanisms_of(tried: Iterable[Tried]) -> list[str]:
    """Every mechanism that a model has, in alphabetical order."""
    return sorted({name for each in tried for name in each.effects})


def model_space(tried: Sequence[Tried]) -> list[list[str]]:
    """The rows of model_space.tsv, its heading first."""
    names = mechanisms_of(tried)
    rows = [
        [named(each), BASE, *("estimate" if name in each.effects else "0" for name in names)]
        for each in tried
    ]
    return [["model_subspace_id", "model_subspace_petab_yaml", *names], *rows]


def parameters(tried: Sequence[Tried]) -> list[list[str]]:
    """The rows of the PEtab table of parameters: coordinates of the search, standard normal, 0 without an effect."""
    heading = ["parameterId", "parameterScale", "lowerBound", "upperBound", "nominalValue", "estimate"]
    base = [[each.name.replace(".", "_"), "lin", "-10", "10", "0", "1"] for each in FREE]
    return [heading, *base, *([name, "lin", "-10", "10", "0", "0"] for name in mechanisms_of(tried))]


def by_evidence(tried: Sequence[Tried], threshold: float) -> list[dict[str, Any]]:
    """The models with the criterion of the search; ``threshold`` is that of detection."""
    odds = (0.0, threshold, threshold + RULES.second)
    return [_model(each, tried, {"NLLH": odds[len(each.effects)] - each.ln_evidence}) for each in tried]


def by_likelihood(tried: Sequence[Tried], samples: int) -> list[dict[str, Any]]:
    """The models with NLLH, AIC and BIC at their most probable parameters, for so many ``samples``."""
    return [_model(each, tried, _criteria(each, samples)) for each in tried]


def chosen(models: Iterable[Mapping[str, Any]]) -> str:
    """The model of the least NLLH."""
    return str(min(models, key=lambda each: each["criteria"]["NLLH"])["model_id"])


def named(tried: Tried) -> str:
    """A name for a model, as an identifier."""
    return "_and_".join(tried.effects) or NONE


def _criteria(tried: Tried, samples: int) -> dict[str, float]:
    least, unknowns = tried.negative_ln_likelihood, tried.unknowns
    return {"NLLH": least, "AIC": 2.0 * (unknowns + least), "BIC": unknowns * log(samples) + 2.0 * least}


def _model(each: Tried, tried: Sequence[Tried], criteria: Mapping[str, float]) -> dict[str, Any]:
    names = mechanisms_of(tried)
    return {
        "model_id": named(each),
        "model_subspace_id": named(each),
        "model_subspace_indices": [0] * len(names),
        "model_subspace_petab_yaml": BASE,
        "parameters": {name: "estimate" if name in each.effects else 0 for name in names},
        "criteria": dict(criteria),
    }
