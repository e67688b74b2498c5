"""Measured programs, each in a separate single-threaded process."""

import json
import os
import resource
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.ventricles import FOLDER, ROOT

THREADS = ("OMP", "OPENBLAS", "MKL", "NUMBA")
PYTHON = FOLDER / "peers" / ("Scripts" if os.name == "nt" else "bin") / "python"
"""Interpreter of the environment with the other programs, without ours."""


@dataclass(frozen=True)
class Run:
    """Wall time of a process [s], and its output."""

    cpu: float
    wall: float
    printed: str


def run(*command: str | Path, library: Path | None = None) -> Run:
    """Run a program in the project's folder, with compiled sources of this or another ``library``.

    Raises CalledProcessError if it fails.
    """
    environment = os.environ | {f"{name}_NUM_THREADS": "1" for name in THREADS}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    if library is not None:
        environment["PYTHONPATH"] = str(library)
    before, begin = _children(), time.monotonic()
    process = subprocess.run(
        list(map(str, command)), cwd=ROOT, env=environment, check=True, capture_output=True, text=True
    )
    return Run(_children() - before, time.monotonic() - begin, process.stdout)


def ask(
    *arguments: str | Path, python: Path | str = sys.executable, library: Path | None = None
) -> dict[str, Any]:
    """JSON in the last line that a Python program prints."""
    return json.loads(run(python, *arguments, library=library).printed.splitlines()[-1])


def install_peers() -> None:
    """Install the other programs of requirements.txt into a separate environment, once."""
    if not PYTHON.exists():
        run(sys.executable, "-m", "venv", PYTHON.parents[1])
    run(PYTHON, "-m", "pip", "install", "--quiet", "--requirement", ROOT / "benchmarks" / "requirements.txt")


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
