"""The page of the benchmark of hidden effects."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from heartfit.planting.least import Least
from heartfit.planting.scoring import Scored
from heartfit.tables.planted_by_data import by_data_section, by_data_table
from heartfit.tables.planted_table import cases_table, mechanisms_table, rates_table
from heartfit.tables.text import to_markdown

PAGE = """# Hidden effects: how often their cause is found

Written by `snakemake --cores 2 discovery_benchmark`. {cases} hearts that are not the diagnoser's model, in which
nothing, one mechanism of the library, two, or an effect from outside it was hidden by a seed ({seeds}); the thresholds
were tuned on seeds below 1000. The answers were sealed in files that the diagnosis is not given and opened afterwards.
How the search works: [discovery.md](discovery.md); hidden in 3-D:
[discovery_benchmark_3d.md](discovery_benchmark_3d.md). {planned}

## What is hidden, and in what

The generator (`src/heartfit/planting`) is a sphere of the same law with steps of 1 ms of first order instead of 5 ms of
second, orifice valves with inertance instead of conductances, a wall with mass, a length dependence whose slope
scatters about 0.3 instead of none, and another amount of wall and spread of the activation in every heart. All
parameters that the search frees are drawn from their priors. Volumes have 25 to 30 frames with errors of 1 to 3 % of
the end-diastolic volume that remember 0.6 of the frame before, pressures 0.3 kPa at 1 kHz averaged over 10 ms; smooth
errors of 0.6 mL and 0.15 kPa stand for all that no model explains. The diagnosis is told none of these levels. Draws
with an end-diastolic volume outside 80 to 300 mL, an ejection fraction outside 15 to 80 %, a peak pressure outside 8 to
30 kPa or no limit cycle were refused and drawn anew: {refused} of {drawn}.

## Rates

Intervals are exact (Clopper and Pearson 1934). An effect is above its limit where [the data are expected to show
it](detection_limits.md) in an average adult.

{rates}
![Every rate with its interval and its target](figures/discovery_rates.png)

{gain}

## Which cause is taken for which

![What was said of what was planted](figures/discovery_confusion.png)

## Power, in the unit of each mechanism

![ln Bayes factor over the planted size](figures/discovery_power.png)

{mechanisms}{by_data}
A search took {simulations:.0f} simulations and {seconds:.1f} s of one core (medians).
"""


def planted_tables(scored: Sequence[Scored], least: Least) -> dict[str, pd.DataFrame]:
    """The tables of the benchmark by name; least: detection limits."""
    return {
        "rates": rates_table(scored, least.rates()),
        "mechanisms": mechanisms_table(scored),
        "data": by_data_table(scored),
        "cases": cases_table(scored),
    }


def planted_page(scored: Sequence[Scored], planned: int, fingerprint: str, least: Least) -> str:
    """The page in Markdown; its figures are those of heartfit.tables.planted_figures.

    planned: cases of the whole benchmark, of which these are the first; fingerprint: of the code that diagnosed;
    least: detection limits.
    """
    seeds = [each.answer.seed for each in scored]
    refused = sum(sum(each.answer.rejected.values()) for each in scored)
    return PAGE.format(
        cases=len(scored),
        planned=_planned(len(scored), planned, fingerprint),
        seeds=f"{min(seeds)} to {max(seeds)}",
        refused=refused,
        drawn=refused + len(scored),
        rates=to_markdown(rates_table(scored, least.rates())),
        gain=_gain([each for each in scored if each.right]),
        mechanisms=to_markdown(mechanisms_table(scored)),
        by_data=by_data_section(scored),
        simulations=np.median([each.finding.simulations for each in scored]),
        seconds=np.median([each.finding.seconds for each in scored]),
    )


def _planned(cases: int, planned: int, fingerprint: str) -> str:
    """How much of the benchmark this is, and of which code."""
    whole = "all" if cases == planned else "the first"
    return f"They are {whole} {cases} of {planned} cases, in an order shuffled by the first seed; code `{fingerprint}`."


def _gain(right: Sequence[Scored]) -> str:
    """What rightly named causes gain on curves that were held out."""
    ratios = [each.finding.gain[PRESSURE] for each in right if PRESSURE in each.finding.gain]
    if not ratios:
        return "No cause was named rightly, so nothing can be said of its gain."
    low, middle, high = np.percentile(ratios, (25.0, 50.0, 75.0)).tolist()
    return (
        f"Where the cause was named rightly, the error of the held-out pressure fell to {middle:.2f} of what it was "
        f"(median of {len(ratios)} cases, quartiles {low:.2f} and {high:.2f}); the target is 0.65."
    )


PRESSURE = "lv_pressure"
