"""Average the recorded pressure of a measured heart to one beat with the period of its images."""

from pathlib import Path

from heartfit.io.curves import write_curves
from heartfit.io.meshes import read_motion
from heartfit.io.pressures import read_pressure
from heartfit.io.run import record

record(snakemake.log[0])
period = read_motion(Path(snakemake.input.motion)).period
averaged = read_pressure(snakemake.params.source.pressure, period)
write_curves(Path(snakemake.output[0]), {"lv_pressure": averaged.curve})
