"""Generate the beats of a simulator: python -m benchmarks.other_worlds WORLD

WORLD: regazzoni, korakianitis and naghavi need the packages of requirements.txt, physioblocks and svzerod those of
requirements-2.txt, in an environment of their own. Some minutes. Writes resources/other_worlds/WORLD.csv: a row for
each beat, HEALTHY healthy adults, then EACH further ones for every illness and severity, their beats before and with
the illness one after the other; of korakianitis, whose beats take longest, a third of them. Adults whose healthy beat
lies outside published ranges are drawn anew.
"""

import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path

import numpy as np

from benchmarks.other_worlds.adult import ILLNESSES, SEVERITIES, Adult, Beat, adults, ill

WORLDS: dict[str, tuple[str, str, int, dict[str, float]]] = {
    "regazzoni": ("benchmarks.other_worlds.regazzoni", "simulate", 1000, {}),
    "korakianitis": (
        "benchmarks.other_worlds.modular",
        "simulate_korakianitis",
        2000,
        {"size": 1.4, "resistance": 1.4, "filling": 1.2},
    ),
    "naghavi": (
        "benchmarks.other_worlds.modular",
        "simulate_naghavi",
        3000,
        {"size": 1.4, "contractility": 1.2},
    ),
    "physioblocks": (
        "benchmarks.other_worlds.physio",
        "simulate",
        4000,
        {"contractility": 1.15, "resistance": 0.9},
    ),
    "svzerod": (
        "benchmarks.other_worlds.svzerod_loop",
        "simulate",
        5000,
        {"size": 1.4, "stiffness": 0.5, "resistance": 0.85, "filling": 1.4},
    ),
}
"""Module, function, first seed, and factors that make an adult of its published heart, by simulator."""
HEALTHY, EACH = 16, 2
FEWER = {"korakianitis": (6, 1)}
"""Numbers instead of HEALTHY and EACH."""
PHASES = 200
FOLDER = Path(__file__).resolve().parents[2] / "resources" / "other_worlds"
Row = tuple[int, str, str, Beat]


def main(arguments: list[str]) -> int:
    if len(arguments) != 1 or arguments[0] not in WORLDS:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    module, function, first_seed, centre = WORLDS[arguments[0]]
    numbers = FEWER.get(arguments[0], (HEALTHY, EACH))
    rows = beats(getattr(import_module(module), function), adults(first_seed, centre), *numbers)
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / f"{arguments[0]}.csv").write_text("".join(map(line, rows_with_head(rows))), encoding="utf-8")
    return 0


def beats(
    simulate: Callable[[Adult], Beat], drawn: Iterator[tuple[int, Adult]], sound: int, pairs: int
) -> Iterator[Row]:
    """Yield seed, illness, severity and beat of all rows."""
    healthy = healthy_adults(simulate, drawn)
    for _ in range(sound):
        seed, _, beat = next(healthy)
        yield seed, "", "", beat
    for _ in range(pairs):
        for illness in ILLNESSES:
            for severity in SEVERITIES:
                seed, adult, before = next(healthy)
                yield seed, "", "", before
                yield seed, illness, severity, simulate(ill(adult, illness, severity))


def healthy_adults(
    simulate: Callable[[Adult], Beat], drawn: Iterator[tuple[int, Adult]]
) -> Iterator[tuple[int, Adult, Beat]]:
    """Yield seeds, adults and beats within the published ranges."""
    for seed, adult in drawn:
        beat = simulate(adult)
        indices = " ".join(f"{name} {value:.3g}" for name, value in beat.indices().items())
        sys.stderr.write(f"{seed}: {indices}{'' if beat.healthy() else ', drawn anew'}\n")
        if beat.healthy():
            yield seed, adult, beat


def rows_with_head(rows: Iterator[Row]) -> Iterator[list[str]]:
    """Yield the head and the rows as cells."""
    phases = [f"{kind}{phase}" for kind in ("volume_ml_", "pressure_mmhg_") for phase in range(PHASES)]
    yield ["seed", "illness", "severity", "period_s", *phases]
    for seed, illness, severity, beat in rows:
        sys.stderr.write(f"  {seed} {illness} {severity}: {beat.indices()}\n")
        curves = (resampled(curve) for curve in (beat.volume, beat.pressure))
        values = [f"{value:.2f}" for curve in curves for value in curve]
        yield [str(seed), illness, severity, f"{beat.period:.4f}", *values]


def resampled(curve: np.ndarray) -> np.ndarray:
    """Return a periodic curve at PHASES phases."""
    places = np.arange(PHASES) / PHASES
    return np.asarray(np.interp(places, np.arange(curve.size) / curve.size, curve, period=1.0))


def line(cells: list[str]) -> str:
    """Return a row of the table."""
    return ",".join(cells) + "\n"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
