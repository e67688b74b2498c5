"""What registration costs, by acquisition and by segment: tables and Fig. 6."""

from itertools import repeat
from pathlib import Path

from heartfit.io.comparisons import read_comparison
from heartfit.io.log import record
from heartfit.io.tables import write_figure, write_table
from heartfit.tables.acquisitions import Acquisitions
from heartfit.tables.registration_figure import plot_registration
from heartfit.tables.registration_table import registration_table, segment_table

record(snakemake.log[0])
given, out = snakemake.params, snakemake.output
acquisitions = Acquisitions.of(given.settings, given.tried, map(read_comparison, map(Path, snakemake.input)))
list(map(write_table, map(Path, out.costs), repeat(registration_table(acquisitions))))
list(map(write_table, map(Path, out.segments), repeat(segment_table(acquisitions.baseline))))
figure = plot_registration(acquisitions, given.operator.trial_features(given.frames)["lv_volume"])
list(map(write_figure, map(Path, out.figure), repeat(figure)))
