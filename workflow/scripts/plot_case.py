"""Plot the beats of one calibrated case, the sensitivity of its observations, and the shape of its motion."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.figures import write_figures
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.results import read_case, read_posterior
from heartfit.io.run import record
from heartfit.io.tables import read_shape, write_tables
from heartfit.observation.beat import beat_curves
from heartfit.observation.shape import motion_shape
from heartfit.results.case_figures import case_figures
from heartfit.results.shape import end_systole_table, shape_table
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, out, params = snakemake.input, snakemake.output, snakemake.params
result, measured = read_case(Path(files.errors)), read_curves(Path(files.measured))
curves = {
    "measured": measured,
    "reference": beat_curves(read_beat(Path(files.reference)), params.setting.sensors(result.prior)),
    "calibrated": beat_curves(read_beat(Path(files.calibrated)), params.setting.sensors(result.estimate)),
}
motion = motion_shape(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
shapes = {"measured": shape_table(motion), "calibrated": read_shape(Path(files.shape))}
features, posterior = params.operator.features(measured)["lv_volume"], read_posterior(Path(files.posterior))
figures = case_figures(result, curves, features, posterior, shapes, params.colour)
write_figures([*out.curves, *out.sensitivity, *out.shape], figures)
table = render_tables({f"{result.case}_{result.setting}_shape": end_systole_table(shapes)})
write_tables(Path(out.table[0]).parent, table)
