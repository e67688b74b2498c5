"""CPU seconds of the engine, of this library or of another commit's: `python -m benchmarks.engine` prints JSON.

It uses only what every version of the library has: a first beat and three beats on each mesh, a stress-free reference,
a beat of a sphere, the search for the cause in one planted heart. Medians of warm runs.
"""

import json
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import heartfit
from benchmarks import sphere as spheres
from benchmarks.job import processes
from benchmarks.process import ask
from benchmarks.ventricles import FOLDER, ROOT, mesh_file
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.simulation import simulate
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh
from heartfit.personalise.run import ventricles
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import plant

PERIOD, REPEATS, BEATS, ROUNDS = 0.86, 3, 3, 3
MESHES = ("3k", "10k")
CONFIGURATION = Path(heartfit.__file__).parents[2] / "config" / "config.yaml"
PLAN = PlantedPlan(1, "single", ("MitralRegurgitation",), 2.5)


def costs() -> dict[str, float]:
    """CPU seconds by name, of the library that is imported."""
    seconds: dict[str, float] = {}
    for name in MESHES:
        seconds |= beats(name, read_mesh(mesh_file(name)))
    return seconds | {"job": job() - seconds[f"beat, {MESHES[0]}"], "sphere": sphere(), "search": search()}


def beats(name: str, mesh: VentricularMesh) -> dict[str, float]:
    """Costs of the reference, of the first beat and of three beats of one mesh under `physical`."""
    study = read_study([CONFIGURATION])
    heart, pressures = study.setting("physical").base_heart(PERIOD), study.end_diastolic_pressure
    loads, numerics = np.array([pressures.lv, pressures.rv]), study.numerics.numerics()
    free = unload(mesh, heart.tissue, loads)

    def simulated(number: int) -> float:
        chosen = replace(numerics, max_beats=number, drift=0.0)
        return median(
            lambda: simulate(heart, ventricles(free, heart.tissue, np.zeros(2), unloaded=False), chosen)
        )

    return {
        f"reference, {name}": median(lambda: unload(mesh, heart.tissue, loads)),
        f"beat, {name}": simulated(1),
        f"three beats, {name}": simulated(BEATS),
    }


def sphere() -> float:
    """Cost of an additional beat of a sphere with one fibre class."""
    case = next(iter(spheres.CASES.values()))
    beat, _ = spheres.cost(lambda number: spheres.standard(*case, number))
    return beat


def search() -> float:
    """Cost of the search for the cause of a planted leak, from a volume and a pressure."""
    recording = Recording.from_curves(plant(PLAN).curves["rest"])
    return median(lambda: diagnose(recording), 1)


def job() -> float:
    """Cost of a process that simulates one beat of the smallest mesh from a given reference."""
    return float(np.median([process.cpu for process in processes(MESHES[0], "physical", CONFIGURATION)]))


def median(work: Callable[[], Any], repeats: int = REPEATS) -> float:
    """Median CPU time of a call [s]; the first call, which loads the kernels, does not count."""
    times = []
    for _ in range(repeats + 1):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return float(np.median(times[1:]))


def costs_in_turn(commit: str) -> tuple[dict[str, float], dict[str, float]]:
    """Medians of the costs at another commit and of this library, measured in turn: the pace of a machine drifts."""
    rounds = [(costs_of(commit), ask("-m", "benchmarks.engine")) for _ in range(ROUNDS)]
    before, now = zip(*rounds, strict=True)
    return medians(before), medians(now)


def medians(rounds: Sequence[dict[str, float]]) -> dict[str, float]:
    """Median of each cost over the rounds."""
    return {name: float(np.median([one[name] for one in rounds])) for name in rounds[0]}


def costs_of(commit: str) -> dict[str, float]:
    """Costs of the library at another commit, checked out beside the meshes."""
    tree = FOLDER / "before"
    if not tree.exists():
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(tree)], check=True)
    subprocess.run(["git", "checkout", "--quiet", commit], cwd=tree, check=True)
    return ask("-m", "benchmarks.engine", library=tree / "src")


if __name__ == "__main__":
    print(json.dumps(costs()))
