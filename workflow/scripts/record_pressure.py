"""Record the pressure of a virtual patient's left ventricle, as a catheter would."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import write_curves
from heartfit.io.run import record
from heartfit.observation.curve import Curve

record(snakemake.log[0])
params = snakemake.params
recorded = params.catheter.record(read_beat(Path(snakemake.input.beat)), params.case.seed)
write_curves(Path(snakemake.output[0]), {"lv_pressure": Curve.of_pressure(*recorded)})
