"""Growth of a study with its cases, sigma points, CPUs and tetrahedra: python -m benchmarks.growth [MESH ...]

The forecast uses the measured costs of resources/costs.tsv; the named meshes are measured, 3k and 10k if none is named.
Stores docs/measured/growth_*.tsv.
"""

import sys
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from benchmarks.beat import cost
from benchmarks.measured_table import read_table, store_table
from benchmarks.ventricles import ROOT, mesh_file
from heartfit.io.campaign import FOOTPRINTS, NEEDS
from heartfit.io.campaign import read_table as read_costs
from heartfit.study.forecast import Footprint, Subjects, chain_seconds, forecast, total_of, wall_seconds
from heartfit.study.need import MEASURED_OWN_TIME, Need

MODULE, RESOURCES = "benchmarks.growth", ROOT / "resources"
KIND, CASES, CPUS = "virtual", (1, 10, 50, 1000), (1, 2, 1000)
SETTINGS, ESTIMATED = 2, 4
"""Settings of every case, and parameters that each estimates from a volume."""
PARAMETERS = (1, 4, 7, 14)
MESHES = "growth_meshes"


def growth(sizes: ArrayLike, costs: ArrayLike) -> float:
    """Exponent a of the cost c n^a by least squares of logarithms, from 2 or more values."""
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])


def main(names: Sequence[str]) -> None:
    """Forecast, measure the meshes, and store the tables; stored rows of other meshes are kept."""
    rows, prints = read_costs(Need, RESOURCES / NEEDS), read_costs(Footprint, RESOURCES / FOOTPRINTS)
    store_table("growth_cases", cases_table(rows, prints), MODULE)
    store_table("growth_points", points_table(rows), MODULE)
    measured = meshes_table({name: cost(name, "physical") for name in names or ("3k", "10k")})
    stored = read_table(MESHES)
    kept = stored if stored.empty else stored[~stored["tetrahedra"].isin(measured["tetrahedra"])]
    table = pd.concat([kept, measured]).sort_values("tetrahedra", key=lambda column: column.astype(int))
    store_table(MESHES, table, f"{MODULE} {' '.join(names)}".strip())


def cases_table(rows: Sequence[Need], prints: Sequence[Footprint]) -> pd.DataFrame:
    """Return jobs, files, GB and hours of a study by number of cases, on few and many CPUs."""
    chain = chain_seconds(rows, KIND)
    return pd.DataFrame([_cases_row(rows, prints, number, chain) for number in CASES])


def _cases_row(
    rows: Sequence[Need], prints: Sequence[Footprint], number: int, chain: float
) -> dict[str, object]:
    subjects = Subjects(number, KIND, SETTINGS, SETTINGS * (2 * ESTIMATED + 1))
    total = total_of(forecast(rows, prints, subjects))
    return {
        "cases": number,
        "jobs": f"{total.jobs:.0f}",
        "files": f"{total.files:.0f}",
        "GB": f"{total.megabytes / 1000:.2g}",
        **{_hours_on(cpus): f"{wall_seconds(total.seconds, chain, cpus) / 3600:.2g}" for cpus in CPUS},
        "Snakemake, h": f"{MEASURED_OWN_TIME.seconds(total.jobs) / 3600:.2g}",
    }


def _hours_on(cpus: int) -> str:
    return f"h on {cpus} CPU{'s' if cpus > 1 else ''}"


def points_table(rows: Sequence[Need]) -> pd.DataFrame:
    """Return sigma points and their time by number of estimated parameters: in turn, and each on a CPU of its own."""
    (one,) = (row.typical_s for row in rows if (row.job, row.kind) == ("simulate_point", KIND))
    return pd.DataFrame(
        [
            {
                "estimated": n,
                "sigma points": 2 * n + 1,
                "s on 1 CPU": f"{(2 * n + 1) * one:.0f}",
                "s on as many CPUs": f"{one:.1f}",
            }
            for n in PARAMETERS
        ]
    )


def meshes_table(costs: Mapping[str, Mapping[str, float]]) -> pd.DataFrame:
    """Return time, memory and file of a beat by number of tetrahedra."""
    return pd.DataFrame(
        [
            {
                "tetrahedra": f"{beat['tetrahedra']:.0f}",
                "beat, CPU s": f"{beat['cpu_s']:.2f}",
                "reference, CPU s": f"{beat['unloading_s']:.2f}",
                "iterations": f"{beat['iterations']:.0f}",
                "memory, MB": f"{beat['peak_mb']:.0f}",
                "mesh, MB": f"{mesh_file(name).stat().st_size / 1e6:.2g}",
            }
            for name, beat in costs.items()
        ]
    )


if __name__ == "__main__":
    main(sys.argv[1:])
