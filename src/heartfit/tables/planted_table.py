"""What a search for causes said of hidden effects, as tables: rates, mechanism by mechanism, case by case."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.planting.effects import Effect
from heartfit.planting.rates import RATES, Rate
from heartfit.planting.scoring import Scored

UNITS = {"m^2": ("cm^2", 1e-4), "s": ("ms", 1e-3), "Pa": ("kPa", 1e3), "1": ("", 1.0), "Pa.s": ("kPa.s", 1e3)}
"""Printed unit and its SI value."""


def rates_table(scored: Sequence[Scored], rates: Sequence[Rate] = RATES) -> pd.DataFrame:
    """One row per rate that has a case: count, share with exact 95 % interval, and target."""
    shares = [(rate, rate.counted(scored)) for rate in rates]
    return pd.DataFrame([_rate(rate, share) for rate, share in shares if share is not None])


def _rate(rate: Rate, share: Any) -> dict[str, Any]:
    met = rate.met(share)
    bound = "" if rate.target is None else f"{'<=' if rate.at_most else '>='} {100 * rate.target:g}"
    return {
        "rate": rate.name,
        "count": f"{round(share.covered * share.sequences)} of {share.sequences}",
        "share (%)": 100.0 * share.covered,
        "low (%)": 100.0 * share.low,
        "high (%)": 100.0 * share.high,
        "target (%)": bound,
        "met": "" if met is None else "yes" if met else "no",
    }


def mechanisms_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """One row per planted effect and size: how often it was detected and named, and how well its size was told."""
    single = [each for each in scored if each.answer.kind in ("single", "outside")]
    groups: dict[tuple[str, str, float], list[Scored]] = {}
    for each in single:
        groups.setdefault((each.answer.kind, each.answer.effects[0].name, each.scales), []).append(each)
    return pd.DataFrame([_mechanism(*key, group) for key, group in sorted(groups.items(), reverse=True)])


def _mechanism(kind: str, name: str, scales: float, group: Sequence[Scored]) -> dict[str, Any]:
    right = [each for each in group if each.right]
    size, unit = printed_size(_planted(group[0]))
    ratios = [each.ratio(_planted(each)) for each in right]
    return {
        "planted": name if kind == "single" else f"{name} (outside)",
        "scales": scales,
        "size": f"{size:.3g} {unit}".strip(),
        "cases": len(group),
        "detected": sum(each.detected for each in group),
        "named right": len(right),
        "in a group": sum(each.in_group for each in group),
        "unknown": sum(each.finding.verdict == "unknown" for each in group),
        "amplitude ratio, median": float(np.median(ratios)) if ratios else np.nan,
        "in its interval": f"{sum(each.covered(_planted(each)) for each in right)} of {len(right)}"
        if right
        else "",
    }


def cases_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """One row per case: what was planted and what was said of it."""
    return pd.DataFrame([_case(each) for each in scored])


def _case(each: Scored) -> dict[str, Any]:
    best = max((named.ln_bayes_factor for named in each.finding.mechanisms), default=np.nan)
    return {
        "seed": each.answer.seed,
        "kind": each.answer.kind,
        "planted": each.planted,
        "scales": each.scales,
        "amplitude (SI)": " + ".join(f"{effect.amplitude:.4g}" for effect in each.answer.effects),
        "verdict": each.finding.verdict,
        "named": " + ".join(sorted(each.finding.names)),
        "ln Bayes factor": best,
        "right": each.right,
        **{f"held-out error ratio, {curve}": ratio for curve, ratio in sorted(each.finding.gain.items())},
        "simulations": each.finding.simulations,
        "seconds": each.finding.seconds,
    }


def _planted(each: Scored) -> Effect:
    return each.answer.effects[0]


def printed_size(effect: Effect) -> tuple[float, str]:
    """How far an effect is from off, in the unit in which it is printed."""
    unit, factor = UNITS.get(effect.unit, (effect.unit, 1.0))
    return abs(effect.amplitude - effect.off) / factor, unit
