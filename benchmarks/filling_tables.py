"""Filling against normal values as tables."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from benchmarks.filling_hearts import (
    HEARTS,
    Indices,
    KeptPrior,
    holds,
    unknowns,
)
from heartfit.calibration.plausible import Limit

PRINTED = {
    "E": ("mL/s", 1e-6, 0),
    "A": ("mL/s", 1e-6, 0),
    "E/A": ("", 1.0, 2),
    "E/EDV": ("1/s", 1.0, 1),
    "time of E": ("ms", 1e-3, 0),
    "time of A": ("ms", 1e-3, 0),
    "deceleration time": ("ms", 1e-3, 0),
    "isovolumic relaxation": ("ms", 1e-3, 0),
    "isovolumic contraction": ("ms", 1e-3, 0),
    "dip": ("mL", 1e-6, 1),
    "backflow": ("mL", 1e-6, 1),
    "EDV": ("mL", 1e-6, 0),
    "ESV": ("mL", 1e-6, 0),
    "EF": ("%", 1e-2, 0),
    "P_max": ("kPa", 1e3, 1),
}
"""Printed unit, its SI value, and decimals of an index."""
VISIBLE_DIP = 0.5e-6
"""Fall of the volume [m^3] that counts as a dip."""


@dataclass(frozen=True)
class Range:
    """Normal range of an index [SI] with its source."""

    quantity: str
    low: float
    high: float
    source: str

    @property
    def limit(self) -> Limit:
        """The range without its source."""
        return Limit(self.quantity, self.low, self.high)


@dataclass(frozen=True, eq=False)
class Measured:
    """Results of the comparison.

    values: indices by group (sphere, 3-D) and heart; observed: those of the measured volume; drawn: by heart, for each
    draw; costs: CPU time of a beat [s] by group and heart.
    """

    values: Mapping[str, Mapping[str, Indices]]
    observed: Indices
    drawn: Mapping[str, Sequence[Indices | None]]
    prior: KeptPrior
    costs: Mapping[str, Mapping[str, float]]


def tables(measured: Measured, ranges: Sequence[Range]) -> dict[str, pd.DataFrame]:
    """Return the tables by name: indices, shares of hearts within normal ranges, costs, and the kept prior."""
    limits = {entry.quantity: entry.limit for entry in ranges}
    return {
        "indices": _table(_values(measured, limits)),
        "shares": _table(_shares(measured, list(limits.values()))),
        "costs": _table(_costs(measured)),
        "prior": _table(_prior(measured.prior)),
    }


def _table(rows: Sequence[Sequence[str]]) -> pd.DataFrame:
    head, *body = rows
    return pd.DataFrame(body, columns=head)


def printed(quantity: str, value: float) -> str:
    """An index in its printed unit, without it."""
    _, unit, decimals = PRINTED[quantity]
    return f"{value / unit:.{decimals}f}"


def _values(measured: Measured, limits: Mapping[str, Limit]) -> list[list[str]]:
    groups = [(group, heart) for group, hearts in measured.values.items() for heart in hearts]
    head = ["index", "normal", *(f"{group}: {heart}" for group, heart in groups), "measured volume"]
    rows = [head]
    for quantity, (unit, *_) in PRINTED.items():
        cells = [
            _cell(quantity, measured.values[group][heart][quantity], limits.get(quantity))
            for group, heart in groups
        ]
        observed = printed(quantity, measured.observed[quantity]) if quantity in measured.observed else ""
        rows.append(
            [f"{quantity}{f', {unit}' if unit else ''}", _range(limits.get(quantity)), *cells, observed]
        )
    return rows


def _cell(quantity: str, value: float, limit: Limit | None) -> str:
    text = printed(quantity, value)
    return text if limit is None or limit.holds(value) else f"**{text}**"


def _range(limit: Limit | None) -> str:
    return f"{printed(limit.quantity, limit.low)} to {printed(limit.quantity, limit.high)}" if limit else ""


def _shares(measured: Measured, limits: Sequence[Limit]) -> list[list[str]]:
    head = [
        "heart",
        *(limit.quantity for limit in limits),
        "all of these",
        f"dip above {1e6 * VISIBLE_DIP:g} mL",
    ]
    rows = [head]
    for heart, drawn in measured.drawn.items():
        counts = [
            *(sum(holds(entry, [limit]) for entry in drawn) for limit in limits),
            sum(holds(entry, limits) for entry in drawn),
            sum(entry is not None and entry["dip"] > VISIBLE_DIP for entry in drawn),
        ]
        rows.append([heart, *(f"{100 * count / len(drawn):.0f} %" for count in counts)])
    return rows


def _costs(measured: Measured) -> list[list[str]]:
    (_, spheres), (_, solids) = measured.costs.items()
    standard = next(iter(HEARTS))
    rows = [["heart", "beat of a sphere, CPU ms", "ratio", "beat in 3-D, CPU s", "ratio in 3-D", "unknowns"]]
    for heart, mechanisms in HEARTS.items():
        sphere, solid = spheres[heart], solids[heart]
        ratios = [f"{cost[heart] / cost[standard]:.2f}" for cost in (spheres, solids)]
        rows.append(
            [heart, f"{1e3 * sphere:.2f}", ratios[0], f"{solid:.2f}", ratios[1], f"+{unknowns(mechanisms)}"]
        )
    return rows


def _prior(prior: KeptPrior) -> list[list[str]]:
    head = [
        "parameter",
        "declared",
        "all draws",
        "kept draws",
        "shift, declared sd",
        "kept of the lower, middle, upper third",
    ]
    rows = [head]
    for entry in prior.parameters:
        moments = (f"{mean:.2f} +- {sd:.2f}" for mean, sd in (entry.declared, entry.drawn, entry.kept))
        shares = ", ".join(f"{100 * share:.0f} %" for share in entry.shares)
        rows.append([entry.parameter, *moments, f"{entry.shift:+.2f}", shares])
    return rows
