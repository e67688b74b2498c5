"""Choose the hidden effect of a sealed heart, and seal it."""

from pathlib import Path

from heartfit.io.run import record
from heartfit.io.seals import seal
from heartfit.synthetic.sealed import hidden_effects

record(snakemake.log[0])
case = snakemake.params.case
seal(Path(snakemake.output[0]), hidden_effects(case.plant, case.plant_scales, case.seed))
