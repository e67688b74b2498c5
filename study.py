#!/usr/bin/env python3
"""Set up the environment and run the study, its tests or its benchmarks, with only Python >= 3.11.

Each command first installs the locked packages into .venv, if necessary.

python3 study.py              run the whole study on two cores, then the measured heart, and print what is found
python3 study.py setup        only install the locked packages into .venv
python3 study.py smoke        run both coarse and short, in some ten minutes
python3 study.py run ARGS     run the study with further arguments for Snakemake, such as --configfile config/smoke.yaml
python3 study.py test ARGS    run the tests; ARGS go to pytest
python3 study.py lint         check style and types, and lint the workflow
python3 study.py benchmark    measure the cost of a beat and store it in docs/measured; half an hour
python3 study.py verification compare the simulator with closed forms and published results; one or two minutes
python3 study.py convergence  measure the effect of mesh and time step, store it in docs/measured; half an hour
python3 study.py mutations    change one line of the sources at a time and see its test fail: new mutants, or --all
python3 study.py browser      test the report in a headless browser: no error, no network access, hearts that beat
python3 study.py docs         build the site of docs/ and of the library in site/; any warning fails
python3 study.py numbers      write the pages with numbers of docs/measured, or first store a NUMBERS.csv there
python3 study.py malformed    check that malformed input, much of it random, is rejected in one line; a minute
python3 study.py tutorial     run every command of docs/own_heart.md with the coarse study; some minutes
python3 study.py slurm        run a small study on a local SLURM that loses a job and its node; as root
python3 study.py faults       kill and damage the smallest study, repair it and store the outcomes; 22 min
python3 study.py lock         update requirements.lock and that of profiles/slurm from pyproject.toml
"""

import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
BIN = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
OLDEST, NEWEST = (3, 11), (3, 13)
LOCK = ROOT / "requirements.lock"
STAMP = ENVIRONMENT / "installed.sha256"
MEASURED = ROOT / "docs" / "measured" / "study.tsv"
CHECK = ("check_numbers",)
"""Comparison of the study's tables with the stored ones; it fails only if a finding is lost."""
DISCOVER = ("discover", "check_discovered")
"""Search and refit of the measured heart, with configuration and results of their own."""
MEASURED_HEART = "config/measured_heart.yaml"
SMOKE = ("config/smoke.yaml", "config/measured_heart_smoke.yaml")
AGREEMENT = "tables/agreement.txt"
"""One line that says whether the tables of a study agree with the stored ones."""
LEFT_OUT = " left out: "
"""In the lines of Snakemake on what a run leaves out."""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
LINTS = (
    ("ruff", "check", "."),
    ("ruff", "format", "--check", "."),
    ("mypy",),
    ("snakefmt", "--check", "Snakefile", "workflow"),
)
# when a job has finished, Snakemake looks up the sizes of all inputs of all ready jobs: limit their number
BRISK = ("--scheduler", "greedy", "--scheduler-subsample", "10")
CONDA = "Specify a conda environment or container for each rule."  # the lock file fixes the software
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
    """Run a command of the list in the module's docstring."""
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
    """Install the locked packages and the project into .venv, unless neither has changed since the last time."""
    wanted = hashlib.sha256(LOCK.read_bytes() + (ROOT / "pyproject.toml").read_bytes()).hexdigest()
    if STAMP.exists() and STAMP.read_text() == wanted:
        return
    print("Set-up: installing the locked packages into .venv (once; one to three minutes)", flush=True)
    # modules are compiled when they are first imported: most of the packages never are
    pip = [*create_environment(), "install", "--quiet", "--disable-pip-version-check", "--no-compile"]
    subprocess.run([*pip, "--require-hashes", "-r", str(LOCK)], check=True)
    subprocess.run([*pip, "--no-deps", "--no-build-isolation", "--editable", str(ROOT)], check=True)
    STAMP.write_text(wanted)


def create_environment() -> list[str]:
    """Create .venv if it is missing and return the command that installs into it."""
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
    """Return the command line of a tool of the environment."""
    return [shutil.which(name, path=str(BIN)) or str(BIN / name), *arguments]


def run(arguments: list[str]) -> int:
    """Run the workflow with the arguments; without any, the study and the measured heart."""
    print(
        f"The study takes about {duration()} minutes on two cores; results that are up to date are kept.",
        flush=True,
    )
    if arguments:
        return snakemake(arguments)
    return run_both([], ["--configfile", MEASURED_HEART], ("results", "results/measured_heart"))


def ready(_: list[str]) -> int:
    """Say where the commands are: the set-up has come before."""
    print(f"installed: {BIN.relative_to(ROOT)} has heartfit, snakemake and python")
    return 0


def smoke(_: list[str]) -> int:
    """Run the study and the measured heart coarse and short."""
    study, heart = SMOKE
    folders = ("results/smoke", "results/measured_heart_smoke")
    return run_both(["--configfile", study], ["--configfile", MEASURED_HEART, heart], folders)


def run_both(study: list[str], heart: list[str], folders: Sequence[str]) -> int:
    """Run the study, its check, then the measured heart, with their arguments; folders: of their results.

    The last lines say what was left out, and whether the tables agree with the stored ones. Numbers that moved are no
    failure; a finding that is lost fails the run, and the measured heart is searched all the same.
    """
    left_out: set[str] = set()
    code = snakemake(study, left_out)
    if code:
        return code
    lost = snakemake([*CHECK, *study], left_out)
    code = snakemake([*DISCOVER, *heart], left_out)
    results, discovered = (ROOT / folder for folder in folders)
    for file in (*discovered.glob("*/discovery/*/cause.md"), *discovered.glob("tables/*_extension.md")):
        print(f"\n{file.relative_to(ROOT)}\n\n{file.read_text(encoding='utf-8')}", flush=True)
    for line in sorted(left_out):
        print(line, flush=True)
    for folder in (results, discovered):
        if (folder / AGREEMENT).is_file():
            print(
                f"{folder.relative_to(ROOT)}: {(folder / AGREEMENT).read_text(encoding='utf-8').strip()}",
                flush=True,
            )
    return code or lost


def snakemake(arguments: Sequence[str], left_out: set[str] | None = None) -> int:
    """Run Snakemake and append the remaining time to its count of steps; add lines on what it leaves out to a set."""
    command = tool("snakemake", "--cores", "2", *BRISK, *arguments)
    begin = time.monotonic()
    with subprocess.Popen(command, stderr=subprocess.STDOUT, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout or ():
            print(line.rstrip() + remaining(line, time.monotonic() - begin), flush=True)
            if left_out is not None and LEFT_OUT in line:
                left_out.add(line.strip())
    return process.returncode


def duration() -> str:
    """Return the duration of a study [min], as the README and docs/study.md print it."""
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
    """Run the tests."""
    # contiguous halves for two processes: neighbouring tests share fixtures, which saves a fifth of the time
    halves = ("--numprocesses", "2", "--dist", "worksteal")
    return subprocess.run(tool("pytest", *halves, *arguments), check=False).returncode


def lint(_: list[str]) -> int:
    """Run all checks and print their commands; fail if one of them fails."""
    failed = 0
    for check in LINTS:
        print("lint:", *check, flush=True)
        failed |= subprocess.run(tool(*check), check=False).returncode
    advice = workflow_advice()
    return int(failed != 0 or bool(advice))


def workflow_advice() -> list[str]:
    """Print and return the advice of `snakemake --lint`, except that to use conda."""
    print("lint: snakemake --lint", flush=True)
    report = subprocess.run(tool("snakemake", "--lint"), capture_output=True, text=True, check=False)
    advice = [line.strip() for line in report.stderr.splitlines() if line.startswith("    * ")]
    if report.returncode and not advice:
        advice = [report.stderr]
    advice = [line for line in advice if CONDA not in line]
    print("\n".join(advice) or "All checks passed!", flush=True)
    return advice


def benchmark(arguments: list[str]) -> int:
    """Measure the cost of a beat and store it in docs/measured; `--small` omits the fine meshes."""
    return subprocess.run(tool("python", "-m", "benchmarks", *arguments), check=False).returncode


def verification(arguments: list[str]) -> int:
    """Print the checks of verification; the arguments are those of `python -m verification`."""
    return subprocess.run(tool("python", "-m", "verification", *arguments), check=False).returncode


def convergence(_: list[str]) -> int:
    """Measure convergence and store it in docs/measured."""
    return subprocess.run(tool("python", "-m", "benchmarks.convergence"), check=False).returncode


def mutations(arguments: list[str]) -> int:
    """Try the mutants that no test has failed of yet, the named ones, or with --all every one."""
    return subprocess.run(tool("python", "-m", "tests.mutations", *arguments), check=False).returncode


def browser(arguments: list[str]) -> int:
    """Test the existing or the named reports and one of synthetic results in a browser."""
    return subprocess.run(tool("python", "-m", "tests.browser", *arguments), check=False).returncode


def docs(_: list[str]) -> int:
    """Build the site from scratch; a broken link, anchor, reference or formula fails."""
    for folder in ("site", "docs/api", "docs/studies", "build/doctrees"):
        shutil.rmtree(folder, ignore_errors=True)
    warnings = ("--nitpicky", "--fail-on-warning", "--keep-going", "--quiet", "--jobs", "2")
    sphinx = tool("python", "-m", "sphinx", *warnings, "-d", "build/doctrees", "docs", "site")
    code = subprocess.run(sphinx, check=False).returncode
    print("docs: failed, see above" if code else "docs: wrote site/index.html", flush=True)
    return code


def numbers(arguments: list[str]) -> int:
    """Write the pages of measured numbers; `--check` only compares them."""
    return subprocess.run(tool("python", "docs/measured_pages.py", *arguments), check=False).returncode


def malformed(arguments: list[str]) -> int:
    """Test the rejection of malformed input; `test` tries fewer random ones."""
    selection = ("--numprocesses", "2", "-m", "long or not long", "tests/malformed")
    return subprocess.run(tool("pytest", *selection, *arguments), check=False).returncode


def tutorial(arguments: list[str]) -> int:
    """Run every command of docs/own_heart.md in a copy of the project, with the coarse study."""
    pages = tool("pytest", "-m", "long", "--capture=no", "tests/tutorials", *arguments)
    return subprocess.run(pages, check=False).returncode


def slurm(arguments: list[str]) -> int:
    """Install the executor for SLURM, run its test and remove the executor.

    The arguments are those of `python -m tests.slurm`. An executor that is left installed asks the controller at every
    start of Snakemake, in each job too, and waits nine seconds where none answers.
    """
    pip = create_environment()
    hashed = ("--no-deps", "--require-hashes", "-r", str(SLURM_LOCK))
    subprocess.run([*pip, "install", "--quiet", "--disable-pip-version-check", *hashed], check=True)
    try:
        return subprocess.run(tool("python", "-m", "tests.slurm", *arguments), check=False).returncode
    finally:
        names = re.findall(r"^([\w-]+)==", SLURM_LOCK.read_text(encoding="utf-8"), re.MULTILINE)
        subprocess.run([*pip, "uninstall", "--quiet", "--yes", *names], check=False)


def faults(arguments: list[str]) -> int:
    """Test recovery from faults and store the outcomes; `--quick` tests a part in some minutes and stores nothing."""
    return subprocess.run(tool("python", "-m", "tests.faults", *arguments), check=False).returncode


def lock(_: list[str]) -> int:
    """Update the lock files."""
    commands = (COMPILE_LOCK, COMPILE_SLURM_LOCK)
    return max(subprocess.run(tool(*command), check=False).returncode for command in commands)


COMMANDS = {
    "run": run,
    "setup": ready,
    "smoke": smoke,
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
