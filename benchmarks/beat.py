"""Cost of one beat, including its memory: `python -m benchmarks.beat MESH SETTING` prints it as JSON.

The beat is the first one of a setting of the study, from the ventricles at rest, filled to the resting atrial
pressures. It includes this filling, the order of elimination and the pattern of the matrix. The stress-free reference
is timed separately; medians exclude the loading of compiled kernels.
"""

import json
import resource
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.process import ask
from benchmarks.ventricles import ROOT, mesh_file
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh
from heartfit.personalise.run import ventricles

PERIOD = 0.86  # s
REPEATS, LONGEST = 3, 30.0  # number of beats; CPU time after which none is started [s]


def cost(name: str, setting: str, *reference: str) -> dict[str, float]:
    """Output of :func:`main` for a mesh by name, run in a separate process."""
    return ask("-m", "benchmarks.beat", mesh_file(name), setting, *reference)


def main(mesh: str, setting: str, reference: str = "unloaded") -> None:
    """Print the cost of a beat; with reference "as it is", the mesh is assumed to be stress-free."""
    study = read_study([ROOT / "config" / "config.yaml"])
    heart, loaded = study.setting(setting).base_heart(PERIOD), read_mesh(Path(mesh))
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    begin = time.process_time()
    free = unload(loaded, heart.tissue, loads) if reference == "unloaded" else loaded
    unloading, numerics = time.process_time() - begin, replace(study.numerics.numerics(), max_beats=1)
    beats = _repeated(lambda: _beat(heart, free, numerics))
    median = beats[int(np.argsort([measured_beat["cpu_s"] for measured_beat in beats])[len(beats) // 2])]
    size = {"tetrahedra": len(free.tets), "nodes": len(free.points), "unloading_s": unloading}
    print(json.dumps(size | median | {"peak_mb": _peak_memory()}))


def _beat(heart: Heart, reference: VentricularMesh, numerics: Numerics) -> dict[str, float]:
    begin = time.process_time()
    beat = simulate(heart, ventricles(reference, heart.tissue, np.zeros(2), unloaded=False), numerics)
    ends = {"completed": float(beat.completed), "cpu_s": time.process_time() - begin}
    return dict(beat.diagnostics) | ends | {"steps": float(max(len(beat.time) - 1, 1))}


def _repeated(work: Callable[[], dict[str, float]]) -> list[dict[str, float]]:
    results = [work()]
    while len(results) < REPEATS and sum(measured_beat["cpu_s"] for measured_beat in results) < LONGEST:
        results.append(work())
    return results


def _peak_memory() -> float:
    """Peak memory of this process so far [MB]; ru_maxrss, in bytes on macOS, includes the parent's on Linux."""
    status = Path("/proc/self/status")
    if status.exists():
        (line,) = [line for line in status.read_text().splitlines() if line.startswith("VmHWM")]
        return int(line.split()[1]) / 1e3
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


if __name__ == "__main__":
    main(*sys.argv[1:])
