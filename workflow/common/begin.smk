"""Reads the configuration and puts the results of an earlier run in order."""

import os
from pathlib import Path

from snakemake.exceptions import WorkflowError

from heartfit.errors import InputError
from heartfit.io.configuration import read_configuration
from heartfit.io.plan import plan_study
from heartfit.io.run import Run
from heartfit.io.sums import keep_sums

# one thread a job: the jobs are what runs in parallel
for library in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

try:
    read_configuration(map(Path, workflow.configfiles))  # Snakemake lets pass a key that stands twice
    PLAN = plan_study(config, thorough=workflow.is_main_process)
    RUN = Run(PLAN.study.results) if workflow.is_main_process else None  # and not a job on another machine
except InputError as problem:
    raise WorkflowError(str(problem)) from None
for line in [PLAN.left_out, *(RUN.put_in_order() if RUN else [])]:
    if line:
        logger.warning(line)


onstart:
    keep_sums(PLAN.study.results)
