"""Plot the beats of one calibrated case, the sensitivity of its observations, and the shape of its motion."""

from itertools import repeat
from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.results import read_case, read_posterior
from heartfit.io.run import record
from heartfit.io.tables import read_shape, write_figure, write_table
from heartfit.observation.beat import beat_curves
from heartfit.observation.shape import motion_shape
from heartfit.results.figures import plot_case, plot_sensitivity
from heartfit.results.motion import end_systole_table, plot_shape, shape_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, out, result = snakemake.input, snakemake.output, read_case(Path(snakemake.input.errors))
setting, title = snakemake.params.setting, f"{result.case}, {result.setting} setting"
curves = {
    "measured": read_curves(Path(files.measured)),
    "reference": beat_curves(read_beat(Path(files.reference)), setting.sensors(result.prior)),
    "calibrated": beat_curves(read_beat(Path(files.calibrated)), setting.sensors(result.estimate)),
}
operator = snakemake.params.operator.features(curves["measured"])["lv_volume"]
figure = plot_case(curves, title, operator, result.shift)
list(map(write_figure, map(Path, out.curves), repeat(figure)))
figure = plot_sensitivity(read_posterior(Path(files.posterior)), title)
list(map(write_figure, map(Path, out.sensitivity), repeat(figure)))
measured = motion_shape(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
shapes = {"measured": shape_table(measured), "calibrated": read_shape(Path(files.shape))}
list(map(write_table, map(Path, out.table), repeat(render_table(end_systole_table(shapes)))))
list(map(write_figure, map(Path, out.shape), repeat(plot_shape(shapes, title))))
