"""Tables of the discovery benchmarks on spheres and ventricles."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.results.planted_table import cases_table, mechanisms_table, populations_table, rates_table
from heartfit.synthetic.scoring import DetectableSizes, Scored, of_population
from heartfit.synthetic.trial import CONDITION, VOLUME

HELD_OUT_CURVE = "lv_pressure"


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


def planted_tables(scored: Sequence[Scored], least: DetectableSizes, planned: int) -> dict[str, pd.DataFrame]:
    """Return the tables of the benchmark on spheres by name.

    least: detection limits; planned: number of cases as searched of the whole benchmark, the first of which are scored.
    """
    return {
        "extent": extent_table(scored, planned),
        "rates": rates_table(scored, least.rates()),
        "populations": populations_table(scored),
        "mechanisms": mechanisms_table(of_population(scored, "as searched")),
        "data": data_table(scored),
        "cases": cases_table(scored),
    }


def extent_table(scored: Sequence[Scored], planned: int) -> pd.DataFrame:
    """Return number and seeds of the hearts of each population, the gain of right names, and what a search took."""
    searched, other = (of_population(scored, name) for name in ("as searched", "misspecified"))
    gains = [
        case.finding.gain[HELD_OUT_CURVE]
        for case in searched
        if case.right and HELD_OUT_CURVE in case.finding.gain
    ]
    columns = {"as searched": _extent(searched, planned), "misspecified": _extent(other, len(other))}
    columns["as searched"] |= {
        "held-out pressure of right names, error ratio (quartiles)": _quartiles(gains),
        **_effort(searched),
    }
    return pd.DataFrame(columns).fillna("").rename_axis("quantity").reset_index()


def ventricles_tables(
    scored: Sequence[Scored], least: DetectableSizes, planned: int
) -> dict[str, pd.DataFrame]:
    """Return the tables of the benchmark in 3-D by name; least: detection limits; planned: number of all cases."""
    return {
        "extent": ventricles_extent(scored, planned),
        "rates": ventricles_rates(scored, least),
        "mechanisms": _with_limits(mechanisms_table(scored), least),
        "cases": cases_table(scored)[CASE_COLUMNS],
    }


CASE_COLUMNS = ["seed", "planted", "amplitude (SI)", "verdict", "named", "ln Bayes factor"]


def ventricles_extent(scored: Sequence[Scored], planned: int) -> pd.DataFrame:
    """Return number and seeds of the hearts, errors of the volume, sizes of right names, and what a search took."""
    errors = [100.0 * case.answer.volume_noise for case in scored]
    pairs = [(case, effect) for case in scored if case.right for effect in case.answer.effects]
    covered = sum(case.covered(effect) for case, effect in pairs)
    rows = {
        **_extent(scored, planned),
        "error of the registered volume (% of EDV), median": f"{np.median(errors):.2f}",
        "error of the registered volume (% of EDV), largest": f"{max(errors):.2f}",
        "size of right names over the planted one (quartiles)": _quartiles(
            [case.ratio(effect) for case, effect in pairs]
        ),
        "planted size in the interval, of right names": f"{covered} of {len(pairs)}",
        **_effort(scored),
    }
    return pd.DataFrame(rows.items(), columns=["quantity", "value"])


def ventricles_rates(scored: Sequence[Scored], least: DetectableSizes) -> pd.DataFrame:
    """Return the rates of the benchmark on spheres, and those of effects above the detection limit."""
    return rates_table(scored, least.rates(0.80))


def _extent(scored: Sequence[Scored], planned: int) -> dict[str, str]:
    seeds = [case.answer.seed for case in scored]
    refused = sum(sum(case.answer.rejected.values()) for case in scored)
    return {
        "hearts searched": str(len(scored)),
        "hearts planned": str(planned),
        "seeds": f"{min(seeds)} to {max(seeds)}" if seeds else "",
        "draws refused": f"{refused} of {refused + len(scored)}",
    }


def _effort(scored: Sequence[Scored]) -> dict[str, str]:
    return {
        "simulations of a search, median": f"{np.median([case.finding.simulations for case in scored]):.0f}",
        "core s of a search, median": f"{np.median([case.finding.seconds for case in scored]):.1f}",
    }


def _quartiles(ratios: Sequence[float]) -> str:
    """Return median and quartiles; empty without a ratio."""
    if not ratios:
        return ""
    low, median, high = np.percentile(ratios, (25.0, 50.0, 75.0)).tolist()
    return f"{median:.2f} ({low:.2f} to {high:.2f})"


def _with_limits(table: pd.DataFrame, least: DetectableSizes) -> pd.DataFrame:
    if len(table):
        table.insert(2, "limit (scales)", [least.describe(name) for name in table["planted"]])
    return table
