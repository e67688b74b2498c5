"""Download the measured heart from its public repository and add the beat lengths of its cines."""

from pathlib import Path
from shutil import copyfile

from heartfit.io.files import fetch
from heartfit.io.run import record

record(snakemake.log[0])
folder = Path(snakemake.output.timing).parents[1]
fetch(Path(snakemake.input.manifest), snakemake.params.address, folder)
copyfile(snakemake.input.timing, snakemake.output.timing)
