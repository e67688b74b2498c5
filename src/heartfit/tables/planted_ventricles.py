"""The page of the benchmark of effects that are hidden in three dimensions."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from heartfit.discovery.rules import CENTRED
from heartfit.planting.least import Least
from heartfit.planting.scoring import Scored
from heartfit.tables.planted_table import cases_table, mechanisms_table, rates_table
from heartfit.tables.text import to_markdown

PAGE = """# Hidden effects in three dimensions, seen through images

Written by `snakemake --cores 2 discovery_ventricles`; [the benchmark on spheres](discovery_benchmark.md) asks for this
page too. {cases} biventricular hearts, of {planned} planned, in which nothing, one mechanism of the library, one from
outside it or two were hidden by a seed ({seeds}); thresholds are tuned on seeds below 1000, and the answers were sealed
until all verdicts were there.

## What is hidden, and in what

The generator is the virtual volunteers': a tetrahedral mesh of a drawn anatomy, orifice valves and a length dependence
whose slope scatters about 0.3. Its time step and mesh are not those of the diagnoser, and the parameters that the
search frees scatter as in the hidden spheres, by a fifth to a third. {refused} of {drawn} draws were refused as no
patient resembles them. Only mechanisms that show in global volume and pressure are hidden; a regional scar, say, does
not.

The beat is imaged and registered as the volunteers' are ([registration](registration.md)): 25 to 30 frames of the
study's scanner, and the diagnoser's mesh of the first frame carried through them. What errs in the images, a late
trigger say, errs before the scanner and moves every node. The volume that the search sees is the registered mesh's: it
is {error:.2f} % of the end-diastolic volume off (root mean square over the beat, median; at most {worst:.2f} %). The
pressure is a catheter's, 0.3 kPa a sample at 1 kHz with a smooth error of 0.15 kPa.

The diagnosis gets volume, pressure and the mesh of the first frame. It runs **one** three-dimensional beat of that mesh
with all parameters at the mean of the prior, centres the sphere on it and searches on the sphere. It detects from a ln
Bayes factor of {detected:g}, the threshold for data of another structure: of nine hearts without an effect on seeds
below 1000 the largest reached 5.9.

## Rates

Intervals are exact (Clopper and Pearson 1934). The detection limit of an effect is the size at which that ln Bayes
factor is expected, on the sphere of an average adult (`diagnosis/limits.py`).

{rates}
![Largest ln Bayes factor of every case](figures/discovery_3d.png)

## Effect by effect

{mechanisms}
Amplitudes are the sphere's: what the same mechanism needs in three dimensions differs, so an amplitude to be quoted
comes from the refit in three dimensions ([discovery.md](discovery.md)). {amplitudes}

## Case by case

{table}
A search took {simulations:.0f} simulations on the sphere and {seconds:.1f} s of one core, the beat and the centring
included (medians).
"""
SHOWN = ["seed", "planted", "amplitude (SI)", "verdict", "named", "ln Bayes factor"]


def ventricles_rates(scored: Sequence[Scored], least: Least) -> pd.DataFrame:
    """The rates of the benchmark on spheres, and that of the effects that are large enough to be expected to show."""
    return rates_table(scored, least.rates(0.80))


def ventricles_page(scored: Sequence[Scored], planned: int, least: Least) -> str:
    """The page in Markdown; its figure is planted_ventricles_figure's; planned: the number of all cases."""
    seeds = [each.answer.seed for each in scored]
    errors = [each.answer.volume_noise for each in scored]
    refused = sum(sum(each.answer.rejected.values()) for each in scored)
    return PAGE.format(
        cases=len(scored),
        planned=planned,
        seeds=f"{min(seeds)} to {max(seeds)}",
        refused=refused,
        drawn=refused + len(scored),
        detected=CENTRED.detected,
        error=100.0 * np.median(errors),
        worst=100.0 * max(errors),
        rates=to_markdown(ventricles_rates(scored, least)),
        mechanisms=to_markdown(_limited(mechanisms_table(scored), least)),
        amplitudes=_amplitudes([each for each in scored if each.right]),
        table=to_markdown(cases_table(scored)[SHOWN]),
        simulations=np.median([each.finding.simulations for each in scored]),
        seconds=np.median([each.finding.seconds for each in scored]),
    )


def _limited(table: pd.DataFrame, least: Least) -> pd.DataFrame:
    if len(table):
        table.insert(2, "limit (scales)", [least.told(name) for name in table["planted"]])
    return table


def _amplitudes(right: Sequence[Scored]) -> str:
    """How far the sphere's amplitudes are from the planted ones where the name is right."""
    pairs = [(each, effect) for each in right for effect in each.answer.effects]
    if not pairs:
        return "No effect was named rightly, so there is none to compare."
    low, middle, high = np.percentile([each.ratio(effect) for each, effect in pairs], (25, 50, 75)).tolist()
    held = sum(each.covered(effect) for each, effect in pairs)
    return (
        f"Where the name is right it is {middle:.2f} of the planted one (median of {len(pairs)}, quartiles {low:.2f} "
        f"and {high:.2f}), and its 95 % interval holds the planted one in {held} of {len(pairs)}."
    )
