"""Store the comparison of methods and the coverage of a study: python -m benchmarks.alternatives

After a study with config/full.yaml, whose tables `alternatives` and `coverage_sphere` it reads. Stores
docs/measured/calibration_methods.tsv and interval_coverage.tsv, and the figure of the methods.
"""

import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT
from heartfit.io.configuration import read_study
from heartfit.io.figures import write_figure
from heartfit.io.tables import read_published
from heartfit.results.race import POOLED, plot_race
from heartfit.results.text import cell_texts

MODULE = "benchmarks.alternatives"
TABLES = "alternatives", "coverage_sphere"


def main() -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    methods, shares = (read_published(ROOT / study.results / "tables" / f"{name}.csv") for name in TABLES)
    write_figure(ROOT / "docs" / "figures" / "alternatives.png", plot_race(methods))
    store_table("calibration_methods", cell_texts(methods), MODULE)
    store_table("interval_coverage", cell_texts(pooled(shares)), MODULE)


def pooled(shares: pd.DataFrame) -> pd.DataFrame:
    """Coverage over all parameters, by measurement, unknowns and noise."""
    return shares[shares["parameter"] == POOLED].drop(columns=["parameter", "hearts"])


if __name__ == "__main__":
    main()
