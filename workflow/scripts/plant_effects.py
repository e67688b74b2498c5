"""Plant effects in hidden hearts; write recordings into one folder and sealed answers into another."""

from itertools import repeat
from pathlib import Path

from heartfit.io.planting import write_planted
from heartfit.io.run import record
from heartfit.synthetic.case import plant

record(snakemake.log[0])
folders = map(repeat, (Path(snakemake.output.measured), Path(snakemake.output.sealed)))
list(map(write_planted, map(plant, snakemake.params.plans), *folders))
