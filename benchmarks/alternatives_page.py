"""Page of other methods and of coverage, in Markdown."""

import pandas as pd

from heartfit.core.pages import render_page
from heartfit.results.race import POOLED
from heartfit.results.text import to_markdown
from heartfit.study.spheres import SphereStudy

SOLID = "volume, in 3-D"
"""Comparison on two volunteers in 3-D, which is optional."""


def page(race: pd.DataFrame, shares: pd.DataFrame, spheres: SphereStudy) -> str:
    """Render the page: methods, their comparison, and the coverage of intervals.

    race, shares: results of `race_table` and `sphere_coverage_table`.
    """
    pooled = shares[shares["parameter"] == POOLED].drop(columns=["parameter", "hearts"])
    return render_page(
        "alternatives",
        hearts=spheres.hearts,
        solid=bool((race["measured"] == SOLID).any()),
        race=to_markdown(race),
        covered=spheres.covered,
        shares=to_markdown(pooled),
    )
