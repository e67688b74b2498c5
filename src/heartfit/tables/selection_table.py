"""Which four and which seven parameters are chosen, by the rule, by the paper and by the study."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.sensitivity.covariance import Sensitivity
from heartfit.sensitivity.plausible import Plausible
from heartfit.sensitivity.selection import rank_among_all, selected, squared_share, volume_share
from heartfit.tables.errors_table import PAPER
from heartfit.tables.sensitivity_table import VOLUME

FOUR = ("sigma_0", "mu", "K", "R_p")
SEVEN = (*FOUR, "k_RS", "k_ATP", "c_1")
"""The paper's choice from a volume curve, and from volume and pressure."""

Sets = Mapping[str, Sequence[str]]


def selection_table(
    found: Mapping[str, Sensitivity],
    ranges: Mapping[str, Plausible],
    estimated: Mapping[str, tuple[Sequence[str], Sequence[str]]],
) -> pd.DataFrame:
    """By setting: what the rule takes, the paper's set and the study's, with two measures of each.

    estimated: what the study estimates from volume and from volume and pressure. "squares (%)": share of the squared
    Cov(X, Z); "volume of Z (%)": det(A_S^T A_S) / det(A^T A), zero for a set that leaves a combination of the
    observations unmoved; "place": among all sets of as many parameters, by that measure. The rule is applied under the
    study's prior and, in a second row, under the deviations of the plausible ranges.
    """
    rows = [
        row
        for setting, sensitivity in found.items()
        for names, paper, study in zip(
            (VOLUME, sensitivity.observations), (FOUR, SEVEN), estimated[setting], strict=True
        )
        for row in _rows(setting, sensitivity, ranges[setting], names, {PAPER: paper, "this study": study})
    ]
    return pd.DataFrame(rows)


def _rows(
    setting: str, found: Sensitivity, ranges: Plausible, names: Sequence[str], sets: Sets
) -> Iterator[dict[str, Any]]:
    common = {"setting": setting, "observed": "volume" if names == VOLUME else "volume and pressure"}
    count = len(next(iter(sets.values())))
    for label, each in (("rule", found), ("rule, plausible prior", found.with_sd(ranges.sd))):
        chosen = [found.parameters[index] for index in selected(each.of(names), count)]
        yield common | {"chosen by": label} | _measures(each, names, chosen)
    for label, given in sets.items():
        if set(given) <= set(found.parameters):
            yield common | {"chosen by": label} | _measures(found, names, given)


def _measures(found: Sensitivity, names: Sequence[str], chosen: Sequence[str]) -> dict[str, Any]:
    covariance = found.of(names)
    rows = [found.parameters.index(name) for name in chosen]
    row: dict[str, Any] = {"parameters": ", ".join(chosen)}
    for label, place, measure in (
        ("squares (%)", "place by squares", squared_share),
        ("volume of Z (%)", "place by volume", volume_share),
    ):
        better, sets = rank_among_all(covariance, rows, measure)
        row |= {label: 100 * measure(covariance, rows), place: f"{better} of {sets}"}
    return row
