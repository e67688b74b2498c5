r"""Mechanisms of a search as a model space of PEtab Select, each model with its criteria.

Each fitted model is a subspace of its own: one column per mechanism, "estimate" if the model has it and 0 if not.
PEtab Select has no criterion for the evidence. A marginal likelihood is the likelihood of a model whose parameters
are all integrated out; therefore the criterion of the search is written as a negative ln likelihood,

.. math:: \mathrm{NLLH} = -\ln Z - \ln \pi_k, \qquad -\ln \pi_0 = 0, \quad -\ln \pi_1 = d, \quad -\ln \pi_2 = d + s,

in which the thresholds of detection d and of a second effect s are prior odds against a model. NLLH, AIC and BIC are
also given at the most probable parameters; because of the priors these are not maximum likelihoods.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import log
from typing import Any

from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.sphere_model.cause import FittedModel
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS, RIGHT_FREE_PARAMETERS

BASELINE = "none"
PETAB_PROBLEM = "petab/problem.yaml"
"""Path of the PEtab problem of all models, relative to the model space."""
SELECT_PROBLEM = {
    "format_version": "1.0.0",
    "criterion": "NLLH",
    "method": "forward",
    "model_space_files": ["model_space.tsv"],
}
PETAB = {
    "format_version": 1,
    "parameter_file": "parameters.tsv",
    "problems": [{"sbml_files": [], "condition_files": [], "measurement_files": [], "observable_files": []}],
}
"""The simulator is not SBML: the problem declares parameters only."""


@dataclass(frozen=True)
class ModelSpace:
    """Files of a PEtab Select problem by relative path: YAML tables and rows of tab-separated values.

    choice: name of the model with the least criterion of the search.
    """

    tables: Mapping[str, Any]
    rows: Mapping[str, Sequence[Sequence[str]]]
    choice: str


def build_model_space(tried: Sequence[FittedModel], threshold: float, samples: int) -> ModelSpace:
    """Return the problem of the fitted models ``tried``; samples: their number; threshold: that of detection."""
    evidence = models_by_evidence(tried, threshold)
    tables = {
        "problem.yaml": SELECT_PROBLEM,
        PETAB_PROBLEM: PETAB,
        "evidence.yaml": evidence,
        "likelihood.yaml": models_by_likelihood(tried, samples),
    }
    rows = {"model_space.tsv": model_space_rows(tried), "petab/parameters.tsv": parameter_rows(tried)}
    return ModelSpace(tables, rows, best_model(evidence))


def mechanism_names(tried: Iterable[FittedModel]) -> list[str]:
    """Return the names of all mechanisms of the models in alphabetical order."""
    return sorted({name for model in tried for name in model.effects})


def model_space_rows(tried: Sequence[FittedModel]) -> list[list[str]]:
    """Return the rows of model_space.tsv, the heading first."""
    names = mechanism_names(tried)
    rows = [
        [model_id(model), PETAB_PROBLEM, *("estimate" if name in model.effects else "0" for name in names)]
        for model in tried
    ]
    return [["model_subspace_id", "model_subspace_petab_yaml", *names], *rows]


def parameter_rows(tried: Sequence[FittedModel]) -> list[list[str]]:
    """Return the rows of the PEtab parameter table: standard normal coordinates, 0 without an effect."""
    heading = ["parameterId", "parameterScale", "lowerBound", "upperBound", "nominalValue", "estimate"]
    count = next(model.unknowns for model in tried if not model.effects)
    free = (*FREE_PARAMETERS, *RIGHT_FREE_PARAMETERS)[:count]
    base = [[parameter.name.replace(".", "_"), "lin", "-10", "10", "0", "1"] for parameter in free]
    return [heading, *base, *([name, "lin", "-10", "10", "0", "0"] for name in mechanism_names(tried))]


def models_by_evidence(tried: Sequence[FittedModel], threshold: float) -> list[dict[str, Any]]:
    """Return the models with the criterion of the search; threshold: that of detection."""
    odds = (0.0, threshold, threshold + DEFAULT_RULES.second)
    return [_model(model, tried, {"NLLH": odds[len(model.effects)] - model.ln_evidence}) for model in tried]


def models_by_likelihood(tried: Sequence[FittedModel], samples: int) -> list[dict[str, Any]]:
    """Return the models with NLLH, AIC and BIC at their most probable parameters; samples: their number."""
    return [_model(model, tried, _criteria(model, samples)) for model in tried]


def best_model(models: Iterable[Mapping[str, Any]]) -> str:
    """Return the name of the model with the least NLLH."""
    return str(min(models, key=lambda model: model["criteria"]["NLLH"])["model_id"])


def model_id(tried: FittedModel) -> str:
    """Return a name for a model that is an identifier."""
    return "_and_".join(tried.effects) or BASELINE


def _criteria(tried: FittedModel, samples: int) -> dict[str, float]:
    least, unknowns = tried.negative_ln_likelihood, tried.unknowns
    return {"NLLH": least, "AIC": 2.0 * (unknowns + least), "BIC": unknowns * log(samples) + 2.0 * least}


def _model(model: FittedModel, tried: Sequence[FittedModel], criteria: Mapping[str, float]) -> dict[str, Any]:
    names = mechanism_names(tried)
    return {
        "model_id": model_id(model),
        "model_subspace_id": model_id(model),
        "model_subspace_indices": [0] * len(names),
        "model_subspace_petab_yaml": PETAB_PROBLEM,
        "parameters": {name: "estimate" if name in model.effects else 0 for name in names},
        "criteria": dict(criteria),
    }
