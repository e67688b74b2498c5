"""Tables of the benchmark of hidden effects: rates, by mechanism and by case; and the check of published claims."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.core.errors import InputError
from heartfit.observation.noise_model import Share
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.scoring import (
    COMPARED_RATES,
    MISSPECIFIED_RATES,
    RATES,
    Rate,
    Scored,
    binomial_p_value,
)

UNITS = {"m^2": ("cm^2", 1e-4), "s": ("ms", 1e-3), "Pa": ("kPa", 1e3), "1": ("", 1.0), "Pa.s": ("kPa.s", 1e3)}
"""Printed unit of an amplitude and its SI value, by SI unit."""


def rates_table(scored: Sequence[Scored], rates: Sequence[Rate] = RATES) -> pd.DataFrame:
    """Return one row per rate with a case: count, share with exact 95 % interval, and target."""
    shares = [(rate, rate.share_of(scored)) for rate in rates]
    return pd.DataFrame([_rate_row(rate, share) for rate, share in shares if share is not None])


def _rate_row(rate: Rate, share: Share) -> dict[str, Any]:
    return {
        "rate": rate.name,
        "count": _printed_count(share),
        "share (%)": 100.0 * share.covered,
        "low (%)": 100.0 * share.low,
        "high (%)": 100.0 * share.high,
        "target (%)": _printed_target(rate),
        "met": _verdict_on_target(rate, share),
    }


def _printed_count(share: Share) -> str:
    return f"{round(share.covered * share.sequences)} of {share.sequences}"


def _printed_target(rate: Rate) -> str:
    return "" if rate.target is None else f"{'<=' if rate.at_most else '>='} {100 * rate.target:g}"


def _verdict_on_target(rate: Rate, share: Share) -> str:
    met = rate.meets_target(share)
    return "" if met is None else "yes" if met else "no"


def populations_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """Return one row per rate with the cases as searched and the misspecified ones, which have the target."""
    rows = zip(COMPARED_RATES, MISSPECIFIED_RATES, strict=True)
    return pd.DataFrame([_compared_row(scored, *rates) for rates in rows])


def _compared_row(scored: Sequence[Scored], rate: Rate, misspecified: Rate) -> dict[str, Any]:
    other = misspecified.share_of(scored)
    met = "" if other is None else _verdict_on_target(misspecified, other)
    return {
        "rate": rate.name,
        **_share_cells("as searched", rate.share_of(scored)),
        **_share_cells("misspecified", other),
        "target (%)": _printed_target(misspecified),
        "met": met,
    }


def _share_cells(population: str, share: Share | None) -> dict[str, str]:
    """Return the count of a population, and its share with the exact 95 % interval; empty without a case."""
    if share is None:
        return {population: "", f"{population} (%)": ""}
    low, covered, high = (100.0 * part for part in (share.low, share.covered, share.high))
    return {
        population: _printed_count(share),
        f"{population} (%)": f"{covered:.1f} ({low:.1f} to {high:.1f})",
    }


def mechanisms_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """Return one row per planted effect and size: detections, names and amplitudes."""
    single = [case for case in scored if case.answer.kind in ("single", "outside")]
    groups: dict[tuple[str, str, float], list[Scored]] = {}
    for case in single:
        groups.setdefault((case.answer.kind, case.answer.effects[0].name, case.scales), []).append(case)
    return pd.DataFrame([_mechanism_row(*key, group) for key, group in sorted(groups.items(), reverse=True)])


def _mechanism_row(kind: str, name: str, scales: float, group: Sequence[Scored]) -> dict[str, Any]:
    correct = [case for case in group if case.right]
    size, unit = printed_size(_planted_effect(group[0]))
    ratios = [case.ratio(_planted_effect(case)) for case in correct]
    return {
        "planted": name if kind == "single" else f"{name} (outside)",
        "scales": scales,
        "size": f"{size:.3g} {unit}".strip(),
        "cases": len(group),
        "detected": sum(case.detected for case in group),
        "named right": len(correct),
        "in a group": sum(case.in_group for case in group),
        "unknown": sum(case.finding.verdict == "unknown" for case in group),
        "amplitude ratio, median": float(np.median(ratios)) if ratios else np.nan,
        "in its interval": f"{sum(case.covered(_planted_effect(case)) for case in correct)} of {len(correct)}"
        if correct
        else "",
    }


def cases_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """Return one row per case: planted effect and diagnosis."""
    return pd.DataFrame([_case_row(case) for case in scored])


def _case_row(case: Scored) -> dict[str, Any]:
    best = max((named.ln_bayes_factor for named in case.finding.mechanisms), default=np.nan)
    return {
        "seed": case.answer.seed,
        "population": case.answer.population,
        "kind": case.answer.kind,
        "planted": case.planted,
        "scales": case.scales,
        "amplitude (SI)": " + ".join(f"{effect.amplitude:.4g}" for effect in case.answer.effects),
        "verdict": case.finding.verdict,
        "named": " + ".join(sorted(case.finding.names)),
        "ln Bayes factor": best,
        "right": case.right,
        **{f"held-out error ratio, {curve}": ratio for curve, ratio in sorted(case.finding.gain.items())},
        "simulations": case.finding.simulations,
        "seconds": case.finding.seconds,
    }


def _planted_effect(case: Scored) -> Effect:
    return case.answer.effects[0]


def printed_size(effect: Effect) -> tuple[float, str]:
    """Return the distance of an effect from its off value, and the printed unit."""
    unit, factor = UNITS.get(effect.unit, (effect.unit, 1.0))
    return abs(effect.amplitude - effect.off) / factor, unit


COLUMNS = ["rate", "claim", "bound", "why"]
BOUNDS = ("at most", "at least")
BY_NAME = {rate.name: rate for rate in (*RATES, *MISSPECIFIED_RATES)}
REFUTATION_PROBABILITY = 0.01
"""Least p-value of a count that does not refute a claim."""


class ClaimError(InputError):
    """A count that refutes a claim about the search for causes."""


def require_claims(scored: Sequence[Scored], claims: pd.DataFrame) -> pd.DataFrame:
    """Return the claims with the counts; claims without a case are omitted.

    Raises ClaimError with the refuted claims, InputError for a table with other columns, rates or bounds.
    """
    _check_columns(claims)
    rows = [row | _count(scored, row) for row in claims.to_dict("records")]
    held = pd.DataFrame([row for row in rows if row["counted"]])
    refuted = [_refuted_line(row) for row in rows if row["doubt"] < REFUTATION_PROBABILITY]
    if refuted:
        raise ClaimError("\n".join([f"{len(refuted)} of {len(held)} claims refuted:", *refuted]))
    return held


def _check_columns(claims: pd.DataFrame) -> None:
    valid = set(claims.get("rate", ())) <= set(BY_NAME) and set(claims.get("bound", ())) <= set(BOUNDS)
    if list(claims.columns) != COLUMNS or not valid:
        raise InputError(
            f"claims: columns {', '.join(claims.columns)}; expected {', '.join(COLUMNS)}, rates among "
            f"{', '.join(BY_NAME)}, bounds {' or '.join(BOUNDS)}"
        )


def _count(scored: Sequence[Scored], row: Mapping[Hashable, Any]) -> dict[Hashable, Any]:
    share = BY_NAME[row["rate"]].share_of(scored)
    if share is None:
        return {"counted": "", "doubt": 1.0}
    return {
        "counted": _printed_count(share),
        "doubt": binomial_p_value(share, row["claim"], row["bound"] == BOUNDS[0]),
    }


def _refuted_line(row: Mapping[Hashable, Any]) -> str:
    claim = f"claimed {row['bound']} {row['claim']:g}, probability {row['doubt']:.1g}"
    return f"  {row['rate']}: {row['counted']}, {claim}"
