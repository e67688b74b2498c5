"""Compare the beats at the prior's mean and at the estimate with the measurement."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.results import read_fingerprint, read_observations, read_posterior, write_case
from heartfit.io.run import record
from heartfit.observation.beat import beat_curves
from heartfit.results.case import summarise

record(snakemake.log[0])
files, setting = snakemake.input, snakemake.params.setting
identity = {**dict(snakemake.wildcards.items()), "fingerprint": read_fingerprint(Path(files.calibrated))}
calibrated = read_beat(Path(files.calibrated))
posterior = read_posterior(Path(files.posterior))
sensors = setting.sensors(posterior.prior.physical()), setting.sensors(posterior.estimate.physical())
curves = {
    "measured": read_curves(Path(files.measured)),
    "reference": beat_curves(read_beat(Path(files.reference)), sensors[0]),
    "calibrated": beat_curves(calibrated, sensors[1]),
}
measurement = read_observations(Path(files.observations))
features = snakemake.params.operator.features(curves["measured"], setting.observe)
result = summarise(
    identity, posterior, measurement, curves, features, setting.units(), calibrated.diagnostics
)
write_case(Path(snakemake.output[0]), result)
