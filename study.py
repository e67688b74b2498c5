#!/usr/bin/env python3
"""Set everything up and do the work, with nothing but Python >= 3.11.

python3 study.py              set up, then run the whole study on two cores
python3 study.py run ARGS     the same with further arguments of Snakemake, as --configfile config/smoke.yaml
python3 study.py test ARGS    set up, then pass the tests; ARGS go to pytest
python3 study.py lint         set up, then style, types and the workflow's own lint
python3 study.py benchmark    set up, then measure what a beat costs and write docs/performance.md; half an hour
python3 study.py verification set up, then compare the simulator with answers from elsewhere; a minute or two
python3 study.py convergence  set up, then see what mesh and time step change and write docs/convergence.md; as long
python3 study.py mutations    set up, then spoil kernels one by one and write which test noticed into docs/mutations.md
python3 study.py browser      set up, then open the report in a headless browser: no error, no network, it beats
python3 study.py docs         set up, then make the site of docs/ and of the library in site/; any warning fails
python3 study.py numbers      set up, then write the pages whose numbers are in docs/measured, of a NUMBERS.csv first
python3 study.py malformed    set up, then see every malformed input refused in one line; under a minute
python3 study.py tutorial     set up, then run every command of docs/own_heart.md, the study coarsely; some minutes
python3 study.py slurm        set up, then lead a small study through a SLURM losing a job and its node; as root
python3 study.py faults       set up, then kill and damage the smallest study, mend it and write docs/faults.md; 22 min
python3 study.py lock         write requirements.lock and that of profiles/slurm anew from pyproject.toml
"""

import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
BIN = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
OLDEST, NEWEST = (3, 11), (3, 13)
LOCK = ROOT / "requirements.lock"
STAMP = ENVIRONMENT / "installed.sha256"
MEASURED = ROOT / "docs" / "measured" / "study.tsv"
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
LINTS = (
    ("ruff", "check", "."),
    ("ruff", "format", "--check", "."),
    ("mypy",),
    ("snakefmt", "--check", "Snakefile", "workflow"),
)
# at every choice, each second, Snakemake looks up the sizes of all inputs of as many jobs as are ready
BRISK = ("--scheduler", "greedy", "--scheduler-subsample", "50")
CONDA = "Specify a conda environment or container for each rule."  # the lock file is what fixes the software
HASHED = (
    *("--universal", "--python-version", "3.11", "--generate-hashes", "--upgrade", "--quiet"),
    *("--no-annotate", "--no-emit-index-url", "--no-emit-find-links"),
    *("--custom-compile-command", "python3 study.py lock"),
)
COMPILE_LOCK = (
    *("uv", "pip", "compile", "pyproject.toml", "--output-file", "requirements.lock", *HASHED),
    *(part for extra in ("alternatives", "develop", "exchange", "site") for part in ("--extra", extra)),
)
SLURM_LOCK = ROOT / "profiles" / "slurm" / "requirements.lock"
COMPILE_SLURM_LOCK = (
    *("uv", "pip", "compile", "--group", "pyproject.toml:slurm", "--no-deps"),
    *("--output-file", str(SLURM_LOCK.relative_to(ROOT)), *HASHED),
)


def main(arguments: list[str]) -> int:
    """Carry out the command that the module's docstring lists."""
    command, rest = (arguments[0], arguments[1:]) if arguments else ("run", [])
    if command not in COMMANDS:
        sys.stderr.write(f"study.py: no command {command!r}; known are {', '.join(COMMANDS)}.\n{__doc__}")
        return 2
    if not OLDEST <= sys.version_info[:2] <= NEWEST:
        sys.stderr.write(
            f"study.py: this is Python {sys.version.split()[0]}; it needs Python 3.11, 3.12 or 3.13 "
            "(the mesher has no wheel for a newer one yet).\n"
        )
        return 2
    os.chdir(ROOT)
    os.environ.update(dict.fromkeys(THREADS, "1"), GIT_PYTHON_REFRESH="quiet")
    set_up()
    return COMMANDS[command](rest)


def set_up() -> None:
    """Install the locked packages and the project into .venv, unless both are as they were then."""
    wanted = hashlib.sha256(LOCK.read_bytes() + (ROOT / "pyproject.toml").read_bytes()).hexdigest()
    if STAMP.exists() and STAMP.read_text() == wanted:
        return
    print("Set-up: installing the locked packages into .venv (once; one to three minutes)", flush=True)
    pip = [*create_environment(), "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "--require-hashes", "-r", str(LOCK)], check=True)
    subprocess.run([*pip, "--no-deps", "--no-build-isolation", "--editable", str(ROOT)], check=True)
    STAMP.write_text(wanted)


def create_environment() -> list[str]:
    """Create .venv if need be and return the command that installs into it."""
    python = BIN / "python"
    own_pip = importlib.util.find_spec("ensurepip") is not None
    if not own_pip and importlib.util.find_spec("pip") is None:
        sys.exit(
            f"study.py: {sys.executable} has neither ensurepip nor pip, so nothing can be installed. "
            "Use a complete Python >= 3.11 (python.org, conda, uv) or, on Debian, the package python3-venv."
        )
    if not python.exists():
        subprocess.run(
            [sys.executable, "-m", "venv", *([] if own_pip else ["--without-pip"]), ENVIRONMENT], check=True
        )
    return [str(python), "-m", "pip"] if own_pip else [sys.executable, "-m", "pip", "--python", str(python)]


def tool(name: str, *arguments: str) -> list[str]:
    """The command line of a tool of the environment."""
    return [shutil.which(name, path=str(BIN)) or str(BIN / name), *arguments]


def run(arguments: list[str]) -> int:
    """Run the workflow, adding the time that remains to Snakemake's count of steps."""
    print(
        f"The study takes about {duration()} minutes on two cores; what is up to date is left alone.",
        flush=True,
    )
    command = tool("snakemake", "--cores", "2", *BRISK, *arguments)
    begin = time.monotonic()
    with subprocess.Popen(command, stderr=subprocess.STDOUT, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout or ():
            print(line.rstrip() + remaining(line, time.monotonic() - begin), flush=True)
    return process.returncode


def duration() -> str:
    """Minutes that a study from a fresh clone took, as the README and docs/study.md print them."""
    rows = (line.split("\t") for line in MEASURED.read_text(encoding="utf-8").splitlines())
    return next(row[1] for row in rows if row[0] == "duration")


def remaining(line: str, elapsed: float) -> str:
    """Return the remaining time to append to a line of Snakemake: the steps left at the mean pace so far."""
    steps = re.match(r"(\d+) of (\d+) steps", line)
    if not steps:
        return ""
    completed, total = map(int, steps.groups())
    return f", {elapsed / 60:.1f} min so far, about {elapsed * (total - completed) / completed / 60:.1f} min left"


def test(arguments: list[str]) -> int:
    """Pass the tests."""
    # half of the tests for each process, in their order: neighbours share what they prepare, a fifth less to do
    halves = ("--numprocesses", "2", "--dist", "worksteal")
    return subprocess.run(tool("pytest", *halves, *arguments), check=False).returncode


def lint(_: list[str]) -> int:
    """Say of each check what was run; fail if one of them does."""
    failed = 0
    for check in LINTS:
        print("lint:", *check, flush=True)
        failed |= subprocess.run(tool(*check), check=False).returncode
    advice = workflow_advice()
    return int(failed != 0 or bool(advice))


def workflow_advice() -> list[str]:
    """Print and return the advice of Snakemake's own lint, except to use conda."""
    print("lint: snakemake --lint", flush=True)
    report = subprocess.run(tool("snakemake", "--lint"), capture_output=True, text=True, check=False)
    advice = [line.strip() for line in report.stderr.splitlines() if line.startswith("    * ")]
    if report.returncode and not advice:
        advice = [report.stderr]
    advice = [line for line in advice if CONDA not in line]
    print("\n".join(advice) or "All checks passed!", flush=True)
    return advice


def benchmark(arguments: list[str]) -> int:
    """Measure what a beat costs and write docs/performance.md; `--small` leaves out the fine meshes."""
    return subprocess.run(tool("python", "-m", "benchmarks", *arguments), check=False).returncode


def verification(arguments: list[str]) -> int:
    """Print the page of verification, or what ARGS of `python -m verification` name."""
    return subprocess.run(tool("python", "-m", "verification", *arguments), check=False).returncode


def convergence(_: list[str]) -> int:
    """Write docs/convergence.md anew."""
    return subprocess.run(tool("python", "-m", "benchmarks.convergence"), check=False).returncode


def mutations(arguments: list[str]) -> int:
    """Write docs/mutations.md anew, or try the mutants that are named."""
    return subprocess.run(tool("python", "-m", "tests.mutations", *arguments), check=False).returncode


def browser(arguments: list[str]) -> int:
    """Open the reports that are there, or that are named, and one of made-up results."""
    return subprocess.run(tool("python", "-m", "tests.browser", *arguments), check=False).returncode


def docs(_: list[str]) -> int:
    """Make the site anew: a link, an anchor, a reference or a formula that is broken is a warning, and that fails."""
    for folder in ("site", "docs/api", "build/doctrees"):
        shutil.rmtree(folder, ignore_errors=True)
    warnings = ("--nitpicky", "--fail-on-warning", "--keep-going", "--quiet", "--jobs", "2")
    sphinx = tool("python", "-m", "sphinx", *warnings, "-d", "build/doctrees", "docs", "site")
    code = subprocess.run(sphinx, check=False).returncode
    print("docs: failed, see above" if code else "docs: site/index.html is there", flush=True)
    return code


def numbers(arguments: list[str]) -> int:
    """Write the pages of measured numbers anew; `--check` compares them only."""
    return subprocess.run(tool("python", "docs/measured_pages.py", *arguments), check=False).returncode


def malformed(arguments: list[str]) -> int:
    """Refuse every malformed input, of which the tests try a part."""
    selection = ("--numprocesses", "2", "-m", "long or not long", "tests/malformed")
    return subprocess.run(tool("pytest", *selection, *arguments), check=False).returncode


def tutorial(arguments: list[str]) -> int:
    """Run every command of docs/own_heart.md in a copy of the project, the study coarsely."""
    pages = tool("pytest", "-m", "long", "--capture=no", "tests/tutorials", *arguments)
    return subprocess.run(pages, check=False).returncode


def slurm(arguments: list[str]) -> int:
    """Add the executor for SLURM, then pass its test; ARGS as `python -m tests.slurm` takes them."""
    hashed = ("--no-deps", "--require-hashes", "-r", str(SLURM_LOCK))
    subprocess.run(
        [*create_environment(), "install", "--quiet", "--disable-pip-version-check", *hashed], check=True
    )
    return subprocess.run(tool("python", "-m", "tests.slurm", *arguments), check=False).returncode


def faults(arguments: list[str]) -> int:
    """Write docs/faults.md anew; `--quick` tries a part in some minutes and writes nothing."""
    return subprocess.run(tool("python", "-m", "tests.faults", *arguments), check=False).returncode


def lock(_: list[str]) -> int:
    """Write the lock files anew."""
    commands = (COMPILE_LOCK, COMPILE_SLURM_LOCK)
    return max(subprocess.run(tool(*command), check=False).returncode for command in commands)


COMMANDS = {
    "run": run,
    "test": test,
    "lint": lint,
    "benchmark": benchmark,
    "verification": verification,
    "convergence": convergence,
    "mutations": mutations,
    "browser": browser,
    "docs": docs,
    "numbers": numbers,
    "malformed": malformed,
    "tutorial": tutorial,
    "slurm": slurm,
    "faults": faults,
    "lock": lock,
}

if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except subprocess.CalledProcessError as failure:
        sys.exit(f"study.py: set-up stopped, see above; the command was: {' '.join(map(str, failure.cmd))}")
