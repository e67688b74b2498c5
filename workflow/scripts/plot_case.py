"""Plot the measured, the reference and the calibrated beat of one case."""

from itertools import repeat
from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.results import read_case
from heartfit.io.run import record
from heartfit.io.tables import write_figure
from heartfit.observation.beat import beat_curves
from heartfit.results.figures import plot_case

record(snakemake.log[0])
files, result = snakemake.input, read_case(Path(snakemake.input.errors))
setting = snakemake.params.setting
curves = {
    "measured": read_curves(Path(files.measured)),
    "reference": beat_curves(read_beat(Path(files.reference)), setting.sensors(result.prior)),
    "calibrated": beat_curves(read_beat(Path(files.calibrated)), setting.sensors(result.estimate)),
}
operator = snakemake.params.operator.features(curves["measured"])["lv_volume"]
title = f"{result.case}, {result.setting} setting"
figure = plot_case(curves, title, operator, result.shift)
list(map(write_figure, map(Path, snakemake.output), repeat(figure)))
