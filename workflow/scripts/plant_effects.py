"""Plant effects in hidden hearts; write recordings into one folder and sealed answers into another."""

from pathlib import Path

from heartfit.io.planting import write_planted
from heartfit.io.run import record
from heartfit.synthetic.case import plant

record(snakemake.log[0])
measured, sealed = Path(snakemake.output.measured), Path(snakemake.output.sealed)
for plan in snakemake.params.plans:
    write_planted(plant(plan), measured, sealed)
