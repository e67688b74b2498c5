"""Page of the benchmark of hidden effects, and the same hearts searched with less and with more data."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.core.pages import render_page
from heartfit.results.planted_table import cases_table, mechanisms_table, rates_table
from heartfit.results.text import to_markdown
from heartfit.synthetic.rates import DetectableSizes
from heartfit.synthetic.scoring import Scored
from heartfit.synthetic.trial import CONDITION, VOLUME


def compare_data(scored: Sequence[Scored]) -> dict[str, Any] | None:
    """Return numbers and table of the section on data; None without a heart searched with less and more data."""
    cases = _searched_with_all_data(scored)
    if not cases:
        return None
    kinds = [case.answer.kind for case in cases]
    return {
        "nulls": kinds.count("none"),
        "singles": kinds.count("single"),
        "scales": max(case.scales for case in cases),
        "table": to_markdown(data_table(cases)),
    }


def data_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """Return one row per set of data over the cases that were searched with each set."""
    cases = _searched_with_all_data(scored)
    by_data = {
        VOLUME: [case.with_data(VOLUME) for case in cases],
        "volume and pressure": cases,
        CONDITION: [case.with_data(CONDITION) for case in cases],
    }
    return pd.DataFrame([{"data": data} | _counts(case) for data, case in by_data.items()])


def _searched_with_all_data(scored: Sequence[Scored]) -> list[Scored]:
    return [case for case in scored if case.finding.other]


def _counts(cases: Sequence[Scored]) -> dict[str, Any]:
    nulls, singles = ([case for case in cases if case.answer.kind == kind] for kind in ("none", "single"))
    correct = [case for case in singles if case.right]
    return {
        "false alarms": f"{sum(case.detected for case in nulls)} of {len(nulls)}",
        "detected": f"{sum(case.detected for case in singles)} of {len(singles)}",
        "named right": len(correct),
        "in their group": sum(case.in_group for case in singles),
        "named wrong": sum(case.named and not case.right for case in cases),
        "insufficient": sum(case.finding.verdict == "insufficient" for case in cases),
        "held-out volume": _median_gain(correct, "lv_volume"),
        "held-out pressure": _median_gain(correct, "lv_pressure"),
    }


def _median_gain(cases: Sequence[Scored], curve: str) -> float:
    ratios = [case.finding.gain[curve] for case in cases if curve in case.finding.gain]
    return float(np.median(ratios)) if ratios else float("nan")


HELD_OUT_CURVE = "lv_pressure"


def planted_tables(scored: Sequence[Scored], least: DetectableSizes) -> dict[str, pd.DataFrame]:
    """Return the tables of the benchmark by name; least: detection limits."""
    return {
        "rates": rates_table(scored, least.rates()),
        "mechanisms": mechanisms_table(scored),
        "data": data_table(scored),
        "cases": cases_table(scored),
    }


def planted_page(scored: Sequence[Scored], planned: int, fingerprint: str, least: DetectableSizes) -> str:
    """Return the page in Markdown; its figures are those of heartfit.results.planted_figures.

    planned: number of cases of the whole benchmark, the first of which are scored; fingerprint: of the diagnosing
    code; least: detection limits.
    """
    seeds = [case.answer.seed for case in scored]
    refused = sum(sum(case.answer.rejected.values()) for case in scored)
    return render_page(
        "discovery_benchmark",
        cases=len(scored),
        planned=planned,
        fingerprint=fingerprint,
        seeds=f"{min(seeds)} to {max(seeds)}",
        refused=refused,
        drawn=refused + len(scored),
        rates=to_markdown(rates_table(scored, least.rates())),
        gain=_pressure_gain([case for case in scored if case.right]),
        mechanisms=to_markdown(mechanisms_table(scored)),
        less=compare_data(scored),
        simulations=np.median([case.finding.simulations for case in scored]),
        seconds=np.median([case.finding.seconds for case in scored]),
    )


def _pressure_gain(correct: Sequence[Scored]) -> dict[str, float] | None:
    """Return quartiles of the held-out pressure error ratio over correctly named cases; None without one."""
    ratios = [case.finding.gain[HELD_OUT_CURVE] for case in correct if HELD_OUT_CURVE in case.finding.gain]
    if not ratios:
        return None
    low, median, high = np.percentile(ratios, (25.0, 50.0, 75.0)).tolist()
    return {"low": low, "median": median, "high": high, "cases": len(ratios)}
