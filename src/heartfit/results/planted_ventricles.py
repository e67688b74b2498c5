"""Pages of the benchmark of effects hidden in three dimensions, and of the detection limits."""

from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd

from heartfit.core.pages import render_page
from heartfit.discovery.inference.decide import CENTRED_RULES, DEFAULT_RULES
from heartfit.discovery.sphere_model.limits import FRAMES, SIZES, DetectionLimit
from heartfit.results.planted_table import UNITS, cases_table, mechanisms_table, rates_table
from heartfit.results.text import to_markdown
from heartfit.synthetic.rates import DetectableSizes
from heartfit.synthetic.scoring import Scored

CASE_COLUMNS = ["seed", "planted", "amplitude (SI)", "verdict", "named", "ln Bayes factor"]


def ventricles_rates(scored: Sequence[Scored], least: DetectableSizes) -> pd.DataFrame:
    """Return the rates of the benchmark on spheres, and those of effects above the detection limit."""
    return rates_table(scored, least.rates(0.80))


def ventricles_page(scored: Sequence[Scored], planned: int, least: DetectableSizes) -> str:
    """Return the page in Markdown; its figure is plot_ventricles'; planned: number of all cases."""
    seeds = [case.answer.seed for case in scored]
    errors = [case.answer.volume_noise for case in scored]
    refused = sum(sum(case.answer.rejected.values()) for case in scored)
    return render_page(
        "discovery_benchmark_3d",
        cases=len(scored),
        planned=planned,
        seeds=f"{min(seeds)} to {max(seeds)}",
        refused=refused,
        drawn=refused + len(scored),
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
