"""Sobol's indices: variance-based sensitivities without the assumption of small steps or a linear model.

With parameters drawn independently from the prior, the variance of an observation is divided into the share of each
parameter alone (first order) and with interactions (total):

    S_i = Var(E[Z | X_i]) / Var(Z),   T_i = 1 - Var(E[Z | all but X_i]) / Var(Z).

SALib samples by Saltelli's scheme, N (n + 2) beats, and estimates the indices. With a single NaN among the outputs it
returns zero for all indices without a warning. Therefore it receives only complete blocks of finite outputs: the n + 2
beats of a base sample are omitted together if one of them failed.

References: Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018; Herman and Usher 2017, doi:10.21105/joss.00097 (SALib).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import Outcome
from heartfit.core.errors import InputError

TRUNCATION = 3.0
"""Truncation of the draws [prior standard deviations]."""

LARGEST_LOSS = 0.05
"""Largest share of omitted base samples; a larger one would bias the distribution."""

Forward = Callable[[Mapping[str, float]], Outcome]


class SobolError(InputError):
    """Too many beats failed for indices of the prior; the message gives the number and the reason."""


@dataclass(frozen=True)
class SobolIndices:
    """Indices (n, m) with the half-widths of their 95 % intervals.

    samples: number of base samples used; lost: reason of each omitted base sample.
    """

    parameters: tuple[str, ...]
    observations: tuple[str, ...]
    first: np.ndarray
    total: np.ndarray
    first_error: np.ndarray
    total_error: np.ndarray
    samples: int
    lost: tuple[str, ...] = ()


def sobol_indices(prior: Gaussian, forward: Forward, samples: int, seed: int) -> SobolIndices:
    """Return the indices over a prior with independent parameters, from `samples` base samples (a power of two).

    Raises SobolError if more than a twentieth of them are omitted.
    """
    from SALib.sample.sobol import sample  # 1 s to import, with pandas and matplotlib

    problem = _problem(prior)
    draws = sample(problem, samples, calc_second_order=False, seed=seed)
    outcomes = [forward(prior.physical(z)) for z in draws]
    return indices_of(prior, outcomes, seed)


def indices_of(prior: Gaussian, outcomes: list[Outcome], seed: int) -> SobolIndices:
    """Return the indices from the outcomes of Saltelli's samples, in their order."""
    from SALib.analyze.sobol import analyze

    names, values, lost = _whole_blocks(outcomes, len(prior.names) + 2)
    silent = [name for name, column in zip(names, values.T, strict=True) if not np.ptp(column) > 0]
    if silent:
        raise SobolError(f"sobol: no parameter changes {', '.join(silent)}: do not observe it")
    problem = _problem(prior)
    analyses = [analyze(problem, column, calc_second_order=False, seed=seed + 1) for column in values.T]
    first, total, first_error, total_error = (
        np.array([analysis[key] for analysis in analyses]).T for key in ("S1", "ST", "S1_conf", "ST_conf")
    )
    _require_finite(np.array([first, total, first_error, total_error]), prior.names, names)
    count = len(values) // (len(prior.names) + 2)
    return SobolIndices(prior.names, names, first, total, first_error, total_error, count, lost)


def _problem(prior: Gaussian) -> dict[str, object]:
    bounds = [
        [m - TRUNCATION * s, m + TRUNCATION * s, m, s] for m, s in zip(prior.mean, prior.sd, strict=True)
    ]
    n = len(prior.names)
    return {"num_vars": n, "names": list(prior.names), "bounds": bounds, "dists": ["truncnorm"] * n}


def _whole_blocks(outcomes: list[Outcome], size: int) -> tuple[tuple[str, ...], np.ndarray, tuple[str, ...]]:
    """Return names and values (k size, m) of the blocks without a failure, and the reasons of the omitted ones."""
    blocks = [outcomes[start : start + size] for start in range(0, len(outcomes), size)]
    reasons = [_reason(block) for block in blocks]
    lost = tuple(reason for reason in reasons if reason)
    if len(lost) > LARGEST_LOSS * len(blocks):
        raise SobolError(
            f"sobol: {len(lost)} of {len(blocks)} base samples have a beat without observations, the first: {lost[0]}; "
            f"expected at most {100 * LARGEST_LOSS:g} %: narrow the prior"
        )
    whole = [
        outcome
        for block, reason in zip(blocks, reasons, strict=True)
        for outcome in block
        if not reason and not isinstance(outcome, str)
    ]
    names = tuple(whole[0])
    return names, np.array([[outcome[name] for name in names] for outcome in whole]), lost


def _reason(block: list[Outcome]) -> str:
    """Reason to reject a block, its first failed beat or NaN; empty for a usable block."""
    for outcome in block:
        if isinstance(outcome, str):
            return outcome
        bad = [name for name, value in outcome.items() if not np.isfinite(value)]
        if bad:
            return f"{', '.join(bad)} not finite"
    return ""


def _require_finite(indices: np.ndarray, parameters: tuple[str, ...], names: tuple[str, ...]) -> None:
    if not np.isfinite(indices).all():
        _, i, j = np.argwhere(~np.isfinite(indices))[0]
        raise SobolError(f"sobol: the index of {names[j]} by {parameters[i]} is not finite: report it")
