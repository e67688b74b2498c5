"""Rows of searched walls, and the rates that follow from rows alone."""

import numpy as np
import pandas as pd

from benchmarks.wall_tables import WallResult, WallTrial, hearts_table, rates_table


def result(
    verdict: str, gains: dict[str, float], discrepancy: float = -5.0, angle: float | None = None
) -> WallResult:
    return WallResult(verdict, gains, discrepancy, angle, None, 90, 240.0)


def trial(effect: str, pressure: WallResult, images: WallResult | None = None, **others: object) -> WallTrial:
    return WallTrial(1, effect, 2.0 if effect else 0.0, pressure=pressure, images=images, **others)  # type: ignore[arg-type]


SOUND = {"angle": None, "affected": None}
SCAR = {"angle": 6.2, "affected": np.zeros(17)}
TRIALS = [
    trial("", result("none", {"Scar": 3.0}), result("none", {}), **SOUND),
    trial("", result("named", {"Scar": 12.0}, angle=1.0), result("unknown", {}, 20.0), **SOUND),
    trial(
        "Scar",
        result("named", {"Pericardium": 1.0, "Scar": 30.0}, angle=0.1),
        result("named", {"Scar": 25.0}, angle=1.2),
        sphere=("Scar",),
        **SCAR,
    ),
    trial("Scar", result("none", {"Scar": 8.0}, angle=6.2), result("none", {}), sphere=(), **SCAR),
    trial("AorticStenosis", result("named", {"MitralStenosis": 9.0}), sphere=("AorticStenosis",), **SOUND),
]


def measured(table: pd.DataFrame) -> list[str]:
    return table["measured"].tolist()


def test_rates_count_their_hearts() -> None:
    assert measured(rates_table(hearts_table(TRIALS))) == [
        "1 of 2",  # a sound heart with a pressure
        "0 of 2",
        "1 of 2",  # a scar of ln B 8 is not seen: it rests on strain
        "1 of 2",
        "1 of 2",
        "1 of 1",
        "0 of 1",  # images alone, 74 degrees off
        "1 of 3",
        "1 of 2",
        "1 of 1",
        "4.0",
    ]


def test_rates_of_stored_rows_are_those_of_the_trials() -> None:
    rows = hearts_table(TRIALS)
    assert measured(rates_table(rows.astype(str))) == measured(rates_table(rows))


def test_errors_of_the_middle_wrap_around() -> None:
    errors = hearts_table(TRIALS)["pressure: error of the middle (deg)"].tolist()
    assert errors == ["", "", "10", "0", ""]
    assert hearts_table(TRIALS)["images alone: verdict"].tolist()[-1] == "–"
