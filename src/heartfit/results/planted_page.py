"""Pages of the discovery benchmarks on spheres and ventricles, and of the detection limits."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.core.pages import render_page
from heartfit.discovery.inference.decide import CENTRED_RULES, DEFAULT_RULES
from heartfit.discovery.sphere_model.limits import FRAMES, SIZES, DetectionLimit
from heartfit.results.planted_table import (
    UNITS,
    cases_table,
    mechanisms_table,
    populations_table,
    rates_table,
)
from heartfit.results.text import to_markdown
from heartfit.synthetic.scoring import DetectableSizes, Scored, of_population
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
        "populations": populations_table(scored),
        "mechanisms": mechanisms_table(of_population(scored, "as searched")),
        "data": data_table(scored),
        "cases": cases_table(scored),
    }


def planted_page(scored: Sequence[Scored], planned: int, fingerprint: str, least: DetectableSizes) -> str:
    """Return the page in Markdown; its figures are those of heartfit.results.planted_figures.

    planned: number of cases as searched of the whole benchmark, the first of which are scored; fingerprint: of the
    diagnosing code; least: detection limits.
    """
    cases = of_population(scored, "as searched")
    return render_page(
        "discovery_benchmark",
        **_extent(cases),
        planned=planned,
        fingerprint=fingerprint,
        rates=to_markdown(rates_table(cases, least.rates())),
        gain=_pressure_gain([case for case in cases if case.right]),
        mechanisms=to_markdown(mechanisms_table(cases)),
        less=compare_data(cases),
        misspecified=compare_populations(scored),
        simulations=np.median([case.finding.simulations for case in cases]),
        seconds=np.median([case.finding.seconds for case in cases]),
    )


def compare_populations(scored: Sequence[Scored]) -> dict[str, Any] | None:
    """Return numbers and table of the section on misspecified hearts; None without one."""
    cases = of_population(scored, "misspecified")
    if not cases:
        return None
    kinds = [case.answer.kind for case in cases]
    return {
        **_extent(cases),
        "nulls": kinds.count("none"),
        "singles": kinds.count("single"),
        "scales": max(case.scales for case in cases),
        "table": to_markdown(populations_table(scored)),
    }


def _extent(scored: Sequence[Scored]) -> dict[str, Any]:
    """Return number and seeds of the cases, and numbers of refused and of all draws."""
    seeds = [case.answer.seed for case in scored]
    refused = sum(sum(case.answer.rejected.values()) for case in scored)
    extent = f"{min(seeds)} to {max(seeds)}"
    return {"cases": len(scored), "seeds": extent, "refused": refused, "drawn": refused + len(scored)}


def _pressure_gain(correct: Sequence[Scored]) -> dict[str, float] | None:
    """Return quartiles of the held-out pressure error ratio over correctly named cases; None without one."""
    ratios = [case.finding.gain[HELD_OUT_CURVE] for case in correct if HELD_OUT_CURVE in case.finding.gain]
    if not ratios:
        return None
    low, median, high = np.percentile(ratios, (25.0, 50.0, 75.0)).tolist()
    return {"low": low, "median": median, "high": high, "cases": len(ratios)}


CASE_COLUMNS = ["seed", "planted", "amplitude (SI)", "verdict", "named", "ln Bayes factor"]


def ventricles_rates(scored: Sequence[Scored], least: DetectableSizes) -> pd.DataFrame:
    """Return the rates of the benchmark on spheres, and those of effects above the detection limit."""
    return rates_table(scored, least.rates(0.80))


def ventricles_page(scored: Sequence[Scored], planned: int, least: DetectableSizes) -> str:
    """Return the page in Markdown; its figure is plot_ventricles'; planned: number of all cases."""
    errors = [case.answer.volume_noise for case in scored]
    return render_page(
        "discovery_benchmark_3d",
        **_extent(scored),
        planned=planned,
        detected=CENTRED_RULES.detected,
        error=100.0 * np.median(errors),
        worst=100.0 * max(errors),
        rates=to_markdown(ventricles_rates(scored, least)),
        mechanisms=to_markdown(_with_limits(mechanisms_table(scored), least)),
        ratio=_amplitude_ratio([case for case in scored if case.right]),
        table=to_markdown(cases_table(scored)[CASE_COLUMNS]),
        simulations=np.median([case.finding.simulations for case in scored]),
        seconds=np.median([case.finding.seconds for case in scored]),
    )


def _with_limits(table: pd.DataFrame, least: DetectableSizes) -> pd.DataFrame:
    if len(table):
        table.insert(2, "limit (scales)", [least.describe(name) for name in table["planted"]])
    return table


def _amplitude_ratio(correct: Sequence[Scored]) -> dict[str, float] | None:
    """Return quartiles of estimated over planted amplitudes of correctly named effects; None without one."""
    pairs = [(case, effect) for case in correct for effect in case.answer.effects]
    if not pairs:
        return None
    low, median, high = np.percentile([case.ratio(effect) for case, effect in pairs], (25, 50, 75)).tolist()
    covered = sum(case.covered(effect) for case, effect in pairs)
    return {"low": low, "median": median, "high": high, "effects": len(pairs), "covered": covered}


def limits_page(limits: Iterable[DetectionLimit], count: int) -> str:
    """Return the page in Markdown; count: number of free parameters."""
    head = ["effect", "detection limit", "in scales", *(f"ln BF at {size:g}" for size in SIZES)]
    rows = [head, ["---"] * len(head), *map(_limit_row, limits)]
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    return render_page(
        "detection_limits", frames=FRAMES, threshold=DEFAULT_RULES.detected, count=count, table=table
    )


def _limit_row(limit: DetectionLimit) -> list[str]:
    sign = {True: "", False: "+" if limit.sign > 0.0 else "-"}[limit.switch.one_sided]
    scales = f"> {SIZES[-1]:g}" if limit.least is None else f"{limit.least:.1f}"
    return [
        f"{limit.name} {sign}".strip(),
        _printed_limit(limit),
        scales,
        *(f"{x:.1f}" for x in limit.factors),
    ]


def _printed_limit(limit: DetectionLimit) -> str:
    """Return the amplitude in the printed unit; "not seen" for an effect below detection at the largest size."""
    if limit.amplitude is None:
        return "not seen"
    unit, factor = UNITS.get(limit.switch.unit, (limit.switch.unit, 1.0))
    return f"{abs(limit.amplitude - (limit.switch.off or 0.0)) / factor:.2g} {unit}".strip()
