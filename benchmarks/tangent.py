"""Cost and accuracy of derivatives of a beat: `python -m benchmarks.tangent [cost | accuracy]` stores both tables.

The cost is CPU time of one core, against that of a beat of every coordinate on its limit cycle. The accuracy is that at
3k against central differences of tightly converged beats. A quarter of an hour.
"""

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import TypeVar

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT, mesh_file
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.free_parameters import HEART_PARAMETERS, RIGHT_HEART_PARAMETERS
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.neighbourhood import LoadedHeart, surround
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.tangent import TANGENT_STEP, TangentBeat, differentiate
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.scar import Scar
from heartfit.observation.strain import DIRECTIONS, segment_strain

STUDY = read_study([ROOT / "config" / "config.yaml"])
LOADS = np.array([STUDY.end_diastolic_pressure.lv, STUDY.end_diastolic_pressure.rv])
PERIOD, SETTING = 0.86, "physical"
SIZE, DIFFERENCE = 0.01, 0.01
"""Distance of the neighbours, and of the converged beats on both sides, in a logarithm."""
NUMERICS = replace(STUDY.numerics.numerics(), max_beats=20, drift=1e-3, keep_positions=True)
CONVERGED = replace(
    NUMERICS,
    drift=1e-6,
    max_beats=60,
    tolerances=Tolerances(force=1e-3, volume=1e-12, pressure=1e-2, iterations=60),
)
LONG_STEP = replace(NUMERICS, time_step=TANGENT_STEP)
"""Numerics of derivatives in searches and refits."""
CASES = (
    ("3k", 8, NUMERICS),
    ("3k", 16, NUMERICS),
    ("3k", 32, NUMERICS),
    ("3k", 64, NUMERICS),
    ("3k", 64, LONG_STEP),
    ("10k", 64, NUMERICS),
    ("10k", 64, LONG_STEP),
)
"""Meshes, numbers of columns and numerics whose cost is measured."""
FIRST_TARGET, SECOND_TARGET = 45.0, 20.0  # CPU time of 64 columns at 3k [s]
WITHIN = {"lv_volume": 3.0, "rv_volume": 3.0, "lv_pressure": 6.0, "strain": 3.0}
"""Targets of the relative root mean square error of a derivative [%], by signal."""
SIDES = DIFFERENCE, -DIFFERENCE
TIMES = np.arange(0.0, PERIOD, TANGENT_STEP)
"""Times [s] in the beat at which derivatives are compared."""
SMALLEST = {"lv_volume": 1e-6, "rv_volume": 1e-6, "lv_pressure": 60.0, "strain": 3e-3}
"""Root mean square derivatives [m^3, Pa, 1] below which a signal hardly depends on a coordinate."""

Result = TypeVar("Result")
Coordinate = Callable[[float], Heart]
"""Heart at a distance along one coordinate."""


def main(*parts: str) -> None:
    """Measure and store the tables, or some of them."""
    for part in parts or ("cost", "accuracy"):
        for table in {"cost": cost_tables, "accuracy": accuracy_tables}[part]():
            store_table(f"tangent_{part}", table, "benchmarks.tangent")


def cost_tables() -> Iterator[pd.DataFrame]:
    """CPU times [s] of derivatives by many columns, and of full beats for the same columns; a table per case."""
    heart, rows = STUDY.setting(SETTING).base_heart(PERIOD), []
    differentiated("3k", heart, free_coordinates(heart, 1))  # loads the compiled kernels
    for mesh, columns, numerics in CASES:
        rows.append(cost_row(mesh, heart, columns, numerics))
        yield pd.DataFrame(rows)


def cost_row(mesh: str, heart: Heart, columns: int, numerics: Numerics) -> dict[str, str]:
    """Cost of one number of columns on a mesh."""
    references, tangent, seconds = differentiated(mesh, heart, free_coordinates(heart, columns), numerics)
    beat = tangent.beat.diagnostics["cpu_s"]
    full = columns * single_beat(mesh)
    converged = 2 * columns * single_beat(mesh, converged=True) if mesh == "3k" else None
    aimed = f"{FIRST_TARGET:.0f}, then {SECOND_TARGET:.0f}" if (mesh, columns) == ("3k", 64) else "–"
    row = {
        "mesh": mesh,
        "columns": f"{columns}",
        "step (ms)": f"{1e3 * numerics.time_step:.0f}",
        "references": f"{references:.1f}",
        "beat": f"{beat:.1f}",
        "lockstep": f"{seconds - beat:.1f}",
        "beat and lockstep": f"{seconds:.1f}",
        "target": aimed,
        "full beats": f"{full:.0f}",
        "ratio": f"{full / (references + seconds):.1f}",
        "converged differences": f"{converged:.0f}" if converged else "–",
        "ratio to them": f"{converged / (references + seconds):.0f}" if converged else "–",
    }
    print(row, flush=True)
    return row


def timed(work: Callable[[], Result]) -> tuple[float, Result]:
    """CPU time [s] and result."""
    begin = time.process_time()
    result = work()
    return time.process_time() - begin, result


@cache
def single_beat(mesh: str, converged: bool = False) -> float:
    """CPU time [s] of one beat on its limit cycle, with its stress-free reference."""
    heart = STUDY.setting(SETTING).base_heart(PERIOD)
    return timed(lambda: beat_of(mesh, heart, CONVERGED if converged else NUMERICS))[0]


def free_coordinates(heart: Heart, columns: int) -> list[Coordinate]:
    """Coordinates of the search that the heart has, repeated with other sizes up to a number of columns."""
    nominal = heart.parameters()
    names = [p for p in (*HEART_PARAMETERS, *RIGHT_HEART_PARAMETERS) if set(p.paths) <= set(nominal)]

    def coordinate(number: int) -> Coordinate:
        parameter, factor = names[number % len(names)], 1 + number // len(names)
        return lambda x: heart.with_parameters(
            {q: parameter.at(nominal[q], factor * x) for q in parameter.paths}
        )

    return [coordinate(number) for number in range(columns)]


def differentiated(
    name: str, heart: Heart, coordinates: Sequence[Coordinate], numerics: Numerics = NUMERICS
) -> tuple[float, TangentBeat, float]:
    """CPU time [s] of the stress-free references, derivatives by the coordinates, and their CPU time [s]."""
    mesh = read_mesh(mesh_file(name))
    hearts = heart, *(coordinate(SIZE) for coordinate in coordinates)
    centre, *others = (LoadedHeart(member, mesh, LOADS) for member in hearts)
    preparation, (body, neighbours) = timed(lambda: surround(centre, others, SIZE))
    seconds, tangent = timed(lambda: differentiate(heart, body, neighbours, numerics))
    return preparation, tangent, seconds


def beat_of(name: str, heart: Heart, numerics: Numerics) -> Beat:
    """Beat of a heart on its limit cycle, from its own stress-free reference."""
    mesh = read_mesh(mesh_file(name))
    return simulate(heart, FiniteElementBody(unload(mesh, heart.muscle, LOADS), heart.muscle), numerics)


def accuracy_tables() -> Iterator[pd.DataFrame]:
    """Errors of derivatives at 3k by coordinate and time step, over their own root mean squares."""
    heart = STUDY.setting(SETTING).base_heart(PERIOD) + MitralRegurgitation(area=2e-6) + Scar(extent=0.1)
    coordinates = coordinates_of(heart)
    tangents = {
        numerics.time_step: differentiated("3k", heart, [*coordinates.values()], numerics)[1]
        for numerics in (NUMERICS, LONG_STEP)
    }
    rows = [
        {"coordinate": "target", "step (ms)": ""} | {name: f"{within:.0f}" for name, within in WITHIN.items()}
    ]
    for column, (name, coordinate) in enumerate(coordinates.items()):
        expected = converged_derivatives(coordinate)
        for step, tangent in tangents.items():
            row = {"coordinate": name, "step (ms)": f"{1e3 * step:.0f}"}
            rows.append(row | accuracies(tangent, column, expected))
            print(rows[-1], flush=True)
        yield pd.DataFrame(rows)


def coordinates_of(heart: Heart) -> dict[str, Coordinate]:
    """Coordinates of every kind: logarithms of parameters, and a shift of the activation by 10 ms."""
    names = {
        "contractility": ("sigma_0",),
        "stiffness": ("c_1", "c_2"),
        "friction": ("mu",),
        "resistance": ("R_p",),
        "mitral valve": ("circulation.mitral.open",),
        "mitral leak": ("MitralRegurgitation.area",),
        "activation": ("onset",),
        "scar": ("Scar.extent",),
        "right contractility": ("tissue.right.contractility",),
        "right resistance": ("circulation.pulmonary_tree.R_p",),
    }
    nominal = heart.parameters()

    def coordinate(name: str, paths: Sequence[str]) -> Coordinate:
        values = {path: nominal[path] for path in map(heart.parameter_path, paths)}
        if name == "activation":
            return lambda x: heart.with_parameters({path: value + 0.01 * x for path, value in values.items()})
        return lambda x: heart.with_parameters({path: value * np.exp(x) for path, value in values.items()})

    return {name: coordinate(name, paths) for name, paths in names.items()}


def converged_derivatives(coordinate: Coordinate) -> dict[str, Floats]:
    """Central differences of tightly converged beats by signal."""
    return _central([beat_of("3k", coordinate(x), CONVERGED) for x in SIDES])


def accuracies(tangent: TangentBeat, column: int, expected: Mapping[str, Floats]) -> dict[str, str]:
    """Errors [%] of the derivatives by one coordinate; in brackets where the signal hardly depends on it."""
    near, row = _central([tangent.near(column, x) for x in SIDES]), {}
    for signal in WITHIN:
        size, error = (
            float(np.sqrt(np.mean(d**2))) for d in (expected[signal], near[signal] - expected[signal])
        )
        text = f"{100.0 * error / size:.1f}"
        row[signal] = text if size > SMALLEST[signal] else f"({text})"
    return row


def _central(beats: Sequence[Beat]) -> dict[str, Floats]:
    """Central differences (t, ...) of the signals of two beats."""
    mesh = read_mesh(mesh_file("3k"))
    above, below = (_signals(mesh, beat) for beat in beats)
    return {signal: (above[signal] - below[signal]) / (SIDES[0] - SIDES[1]) for signal in WITHIN}


def _signals(mesh: VentricularMesh, beat: Beat) -> dict[str, Floats]:
    """Curves (t,) of a beat by name, and the circumferential strain (t, 16) since the start of the beat."""
    motion = nodal_motion(replace(beat, trigger=0.0)).resample(TIMES)
    strain = segment_strain(mesh, motion)[:, DIRECTIONS.index("circumferential")]
    curves = {name: np.interp(TIMES, beat.time, values) for name, values in beat.signals().items()}
    return curves | {"strain": strain}


if __name__ == "__main__":
    main(*sys.argv[1:])
