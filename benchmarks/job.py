"""Cost of one job of `heartfit simulate` beside the beat: start of the process, imports, kernels, files."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.beat import PERIOD, cost
from benchmarks.process import Run, run
from benchmarks.ventricles import ROOT, mesh_file

REPEATS = 5
ONE_BEAT = "numerics: {max_beats: 1}\n"
COMMAND = "import sys; from heartfit.cli.main import main; sys.exit(main())"


@dataclass(frozen=True)
class Job:
    """Medians of some runs of the whole process, and of the same beat in a warm process [s]."""

    cpu: float
    wall: float
    beat: float
    snakemake: float

    @property
    def overhead(self) -> float:
        """CPU time in addition to the beat [s]."""
        return self.cpu - self.beat


def job(name: str, setting: str) -> Job:
    """Cost of one beat on a stress-free mesh, with compiled kernels."""
    runs = processes(name, setting, ROOT / "config" / "config.yaml")
    cpu, wall = (
        float(np.median([getattr(measured_run, what) for measured_run in runs])) for what in ("cpu", "wall")
    )
    return Job(cpu, wall, cost(name, setting, "as it is")["cpu_s"], _snakemake_preamble())


def processes(name: str, setting: str, configuration: Path) -> list[Run]:
    """Runs of the whole process under a configuration; the first, which may compile, does not count."""
    with TemporaryDirectory() as folder:
        one_beat = Path(folder, "one_beat.yaml")
        one_beat.write_text(ONE_BEAT)
        files = ("--config", configuration, one_beat, "--output", Path(folder, "beat.json"))
        how = ("--setting", setting, "--period", str(PERIOD), "--unloaded")
        command = (sys.executable, "-c", COMMAND, "simulate", mesh_file(name), *how, *files)
        return [run(*command) for _ in range(REPEATS + 1)][1:]


def _snakemake_preamble() -> float:
    """CPU time that Snakemake adds to a script [s], by the import in its first line."""
    costs = [
        np.median([run(sys.executable, "-c", line).cpu for _ in range(REPEATS)])
        for line in ("pass", "from snakemake import script")
    ]
    return float(costs[1] - costs[0])


if __name__ == "__main__":
    print(json.dumps(job(*sys.argv[1:]).__dict__))
