"""Movement of ln Bayes factors when data move by a rounding: python -m benchmarks.stable_evidence [HEARTS]

Hidden and sound hearts of the planting campaign in turn, of both populations, are searched three times: as recorded,
and with every value moved at random by 1e-10 and by 1e-6 of itself. Stores docs/measured/stable_evidence_hearts.tsv and
their summary in stable_evidence.tsv. Twenty seconds of one core per heart; a second call measures the hearts that the
table lacks.
"""

import sys
import time as clock
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
import pandas as pd

from benchmarks.measured_table import read_table, store_table
from heartfit.discovery.inference.margin import CLOSE
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.synthetic.campaign import PlantedPlan, Population, plantable
from heartfit.synthetic.case import REST, plant

MODULE, TABLE, SUMMARY = "benchmarks.stable_evidence", "stable_evidence_hearts", "stable_evidence"
FIRST_SEED, HEARTS, SCALES = 800000, 40, 2.5
MOVES = (1e-10, 1e-6)
"""Relative moves of the data: another processor's, and the last digit of a CSV."""
PRINTED_MOVES = ("1e-10", "1e-6")
"""The same in names of columns."""
LEADING = 3
"""Number of hypotheses, the best ones of the search of the data as they are."""


def main(hearts: int) -> None:
    """Search the hearts that the table lacks, and store it after each."""
    table = read_table(TABLE)
    for plan in [plan_of(number) for number in range(hearts)]:
        if table.empty or str(plan.seed) not in set(table["seed"]):
            row = measured(plan)
            table = pd.concat([table, pd.DataFrame([row])], ignore_index=True)
            store_table(TABLE, table, MODULE)
            store_table(SUMMARY, summary(table), MODULE)
            sys.stdout.write(f"{row}\n")
            sys.stdout.flush()


def plan_of(number: int) -> PlantedPlan:
    """Return a sound heart for even numbers, a hidden one for odd ones; two of four are misspecified."""
    seed, hidden = FIRST_SEED + number, number % 2 == 1
    population: Population = "misspecified" if number % 4 > 1 else "as searched"
    if not hidden:
        return PlantedPlan(seed, "none", population=population)
    name = str(np.random.default_rng(seed).choice(sorted(plantable())))
    return PlantedPlan(seed, "single", (name,), SCALES, population=population)


def with_moved_values(recording: Recording, size: float, seed: int) -> Recording:
    """Return the recording with independent relative moves of its values, normal with the deviation ``size``."""
    rng = np.random.default_rng([seed, 1])
    curves = {
        name: Samples(one.times, one.values * (1.0 + size * rng.standard_normal(one.values.size)))
        for name, one in recording.curves.items()
    }
    return replace(recording, curves=curves)


def measured(plan: PlantedPlan) -> Mapping[str, str]:
    """One row: verdicts, margins, ln Bayes factors of the leading hypotheses, and how far they move."""
    started, recording = clock.process_time(), Recording.from_curves(plant(plan).curves[REST])
    searches = [
        SearchedRecording.search(with_moved_values(recording, size, plan.seed).halves()[0])
        for size in (0.0, *MOVES)
    ]
    tables = [factors(one) for one in searches]
    leading = sorted(tables[0], key=tables[0].__getitem__, reverse=True)[:LEADING]
    moves = [max(abs(table.get(name, np.inf) - tables[0][name]) for name in leading) for table in tables[1:]]
    first = [abs(table[leading[0]] - tables[0][leading[0]]) for table in tables[1:]]
    nearest = [one.findings.margin for one in searches]
    return {
        "seed": str(plan.seed),
        "population": plan.population,
        "hidden": " ".join(plan.names),
        "leading": "; ".join(f"{name} {tables[0][name]:.2f}" for name in leading),
        "moves by 1e-10": f"{moves[0]:.3f}",
        "moves by 1e-6": f"{moves[1]:.3f}",
        "best moves by 1e-10": f"{first[0]:.3f}",
        "best moves by 1e-6": f"{first[1]:.3f}",
        "verdicts": "; ".join(verdict(one) for one in searches),
        "margins": "; ".join("" if one is None else f"{abs(one.change):.2f}" for one in nearest),
        "simulations": str(searches[0].findings.simulations),
        "CPU s per search": f"{(clock.process_time() - started) / len(searches):.1f}",
    }


def summary(table: pd.DataFrame) -> pd.DataFrame:
    """Return the numbers of sound, hidden and all hearts that keep ln Bayes factors and verdicts."""
    sound = table["hidden"] == ""
    groups = {"sound": table[sound], "hidden": table[~sound], "all": table}
    return pd.DataFrame({"hearts": list(groups), **_columns(groups.values())})


def _columns(groups: Iterable[pd.DataFrame]) -> dict[str, list[str]]:
    columns: dict[str, list[str]] = {}
    for group in groups:
        changed = group["verdicts"].str.split("; ").map(lambda verdicts: len(set(verdicts)) > 1)
        close = group["margins"].str.split("; ").map(any)
        kept = {
            move: (
                group[[f"{name} by {move}" for name in ("moves", "best moves")]].astype(float) <= CLOSE
            ).sum()
            for move in PRINTED_MOVES
        }
        both = (
            (group[[f"moves by {move}" for move in PRINTED_MOVES]].astype(float) <= CLOSE).all(axis=1).sum()
        )
        row = {
            "number": len(group),
            **{f"leading three kept, {move}": kept[move][f"moves by {move}"] for move in PRINTED_MOVES},
            "leading three kept, both": both,
            **{f"the best kept, {move}": kept[move][f"best moves by {move}"] for move in PRINTED_MOVES},
            "other verdicts": changed.sum(),
            "of these close": (changed & close).sum(),
            "close decisions": close.sum(),
        }
        for name, value in row.items():
            columns.setdefault(name, []).append(str(value))
    return columns


def factors(case: SearchedRecording) -> dict[str, float]:
    """ln Bayes factors over the baseline of all hypotheses, by the names of their effects."""
    evidences = case.findings.evidences
    fitted = {**evidences.singles, **evidences.pairs}
    return {"+".join(effects): value - evidences.baseline for effects, value in fitted.items()}


def verdict(case: SearchedRecording) -> str:
    """Return the decision in words: the verdict, and the effects that it names."""
    decision = case.findings.decision
    named = (decision.effects, *decision.alternatives) if decision.verdict == "group" else (decision.effects,)
    return " ".join([decision.verdict, *sorted("+".join(effects) for effects in named)]).strip()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else HEARTS)
