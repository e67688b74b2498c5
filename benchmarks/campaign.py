"""Fifty coarse virtual hearts in two shards compared with their forecast, 15 minutes.

The forecast uses the costs of five other hearts, run before. All steps are user commands: costs, shards, join.
"""

import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import psutil
import yaml

from benchmarks.campaign_tables import Ran, forecast_table, snakemake_table
from benchmarks.measured_table import store_table
from heartfit.cli.main import main as heartfit
from heartfit.io.campaign import FOOTPRINTS, NEEDS, read_benchmarks, read_table
from heartfit.io.configuration import read_cases, read_study, read_yaml
from heartfit.io.files import write_text
from heartfit.io.tables import read_numbers
from heartfit.results.provenance import calibrated_cases
from heartfit.study.forecast import Footprint, Part, Subjects, forecast, total_of
from heartfit.study.need import Need
from heartfit.synthetic.volunteer import draw_anatomy
from study import BRISK

SMALL, MANY, IN_A_SHARD, CPUS = 5, 50, 25, 2
FOLDER = Path("results", "campaign")
CONFIGURATION = (Path("config", "config.yaml"), Path("config", "tiny.yaml"))
SETTING = "physical"
DRAWN = ("sigma_0", "mu", "c_1", "R_p")


def main() -> int:
    """Run a small study, forecast the large one, run it, and store the tables."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    few = ran(configured("few", SMALL))
    print(f"{SMALL} subjects took {few.wall:.0f} s", flush=True)
    run_heartfit("costs", few.results, "--output", FOLDER / "costs")
    many = configured("many", MANY)
    run_heartfit(
        "shards", "--config", *CONFIGURATION, many, "--size", IN_A_SHARD, "--output", FOLDER / "shards"
    )
    shards = sorted((FOLDER / "shards").glob("*.yaml"))
    planned = [total_of(forecast(*costs(), subjects(shard))) for shard in shards]
    runs = [ran(shard) for shard in shards]
    run_heartfit("join", *(run.results for run in runs), "--output", FOLDER / "joined")
    merged = len(calibrated_cases(read_numbers(FOLDER / "joined" / "numbers.csv")))
    print(f"{merged} subjects in the joined table", flush=True)
    store_table("campaign_forecast", forecast_table(planned, runs), "benchmarks.campaign")
    store_table("campaign_snakemake", snakemake_table([few, *runs], CPUS), "benchmarks.campaign")
    return 0


def configured(name: str, number: int) -> Path:
    """Configuration of a study of virtual hearts, the first of which is the reference."""
    rows = [subject(seed) for seed in range(1, number + 1)]
    cases = FOLDER / f"{name}.tsv"
    write_text(cases, pd.DataFrame(rows).to_csv(sep="\t", index=False, float_format="%.4g"))
    over = read_yaml(CONFIGURATION[1]) | {"cases": cases.as_posix(), "results": f"{FOLDER}/{name}"}
    write_text(cases.with_suffix(".yaml"), yaml.safe_dump(over, sort_keys=False))
    return cases.with_suffix(".yaml")


def subject(seed: int) -> dict[str, object]:
    """Row of a healthy heart: its anatomy, and parameters drawn around the average heart's."""
    anatomy = draw_anatomy(seed)
    shape, drawn = anatomy.shape, np.random.default_rng(seed).uniform(0.9, 1.1, len(DRAWN))
    return {
        **{"case": f"volunteer{seed}", "kind": "virtual", "seed": seed, "conduction": "healthy"},
        **{"period_s": anatomy.period, "sphericity": shape.sphericity},
        **{"edv_ml": 1e6 * shape.edv, "rv_edv_ml": 1e6 * shape.rv_edv},
        **{"wall_thickness_mm": 1e3 * shape.wall_thickness, "rv_wall_thickness_mm": 1e3 * shape.rv_wall_thickness},
        **dict(zip(DRAWN, drawn, strict=True)),
    }  # fmt: skip


def costs() -> tuple[list[Need], list[Footprint]]:
    """Costs and files of the small study."""
    folder = FOLDER / "costs"
    return read_table(Need, folder / NEEDS), read_table(Footprint, folder / FOOTPRINTS)


def subjects(shard: Path) -> Subjects:
    """Configuration files of a shard."""
    study = read_study([*CONFIGURATION, shard])
    cases = read_cases(Path(study.cases))
    return Subjects(len(cases), "virtual", 1, len(study.sigma_points(SETTING, cases[0])))


def run_heartfit(*arguments: object) -> None:
    """Run a command of heartfit; raises RuntimeError if it fails."""
    if heartfit([*map(str, arguments)]):
        raise RuntimeError(f"heartfit {' '.join(map(str, arguments))} failed; what it said stands above")


def ran(file: Path) -> Ran:
    """Run a study to its table of numbers, on idle CPUs."""
    results = Path(read_yaml(file)["results"])
    command = [
        sys.executable,
        "-m",
        "snakemake",
        "--cores",
        str(CPUS),
        *BRISK,
        "--quiet",
        "rules",
        "progress",
        "reason",
    ]
    begin, own = time.monotonic(), 0.0
    with subprocess.Popen(
        [*command, "--configfile", str(file), "--", f"{results}/tables/numbers.csv"]
    ) as process:
        while process.poll() is None:
            own = own_time(process.pid, own)
            time.sleep(0.5)
    if process.returncode:
        raise RuntimeError(f"{file}: Snakemake ended with {process.returncode}")
    jobs = read_benchmarks(results / "benchmarks")
    files = [path.stat().st_size for path in results.rglob("*") if path.is_file()]
    part = Part("all", len(jobs), sum(job.wall for job in jobs), len(files), sum(files) / 1e6)
    return Ran(results, part, time.monotonic() - begin, own)


def own_time(process: int, before: float) -> float:
    """CPU time of a process without its children [s], or the previous value if it has ended."""
    try:
        used = psutil.Process(process).cpu_times()
    except psutil.NoSuchProcess:
        return before
    return used.user + used.system


if __name__ == "__main__":
    sys.exit(main())
