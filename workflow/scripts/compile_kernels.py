"""Compile the numerical kernels, which numba caches next to their sources, and the sources that every job imports."""

from compileall import compile_dir
from pathlib import Path

from heartfit.io.fingerprint import PACKAGE
from heartfit.io.results import write_result
from heartfit.io.run import record
from heartfit.synthetic.kernels import compile_kernels

record(snakemake.log[0])
compile_dir(PACKAGE, quiet=2)
write_result(Path(snakemake.output[0]), compile_kernels().reproducible_diagnostics(), snakemake.params.code)
