"""Compare the beats at the prior's mean and at the estimate with the measurement."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.log import record
from heartfit.io.results import read_fingerprint, read_observations, read_posterior, write_case
from heartfit.protocol import compare

record(snakemake.log[0])
given, files = snakemake.params, snakemake.input
result = compare(
    {**dict(snakemake.wildcards.items()), "fingerprint": read_fingerprint(Path(files.beat))},
    read_posterior(Path(files.posterior)),
    read_observations(Path(files.observations)),
    read_curves(Path(files.measured)),
    list(map(read_beat, map(Path, files.points))),
    read_beat(Path(files.beat)),
    given.setting,
    given.operator,
)
write_case(Path(snakemake.output[0]), result)
