"""Ask whether linear tetrahedra, a mechanism or the locking-free element explains a heart on a finer mesh."""

from itertools import repeat
from pathlib import Path

from heartfit.cohort.template import Template
from heartfit.heart import Heart
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh
from heartfit.io.tables import write_figure, write_table
from heartfit.proof.element import contest, hidden_case, rivals_of
from heartfit.proof.model import Model
from heartfit.tables.element_figure import plot_element
from heartfit.tables.element_table import element_table

record(snakemake.log[0])
files, out, given = snakemake.input, snakemake.output, snakemake.params
asked, size = given.question, given.size
fine, coarse = read_mesh(Path(files.generator)), read_mesh(Path(files.template))
heart = Heart(period=asked.period).with_parameters(given.heart)
template = Template(coarse, size.edge_length, size.tolerance)
case, mesh = hidden_case(fine, template, heart, given.pressures, given.scheme, asked.seed)
model = Model(mesh, asked.period, given.pressures, given.scheme)
rivals = contest(case, model, rivals_of(given.setting, asked.element, asked.mechanism), given.steps)
list(map(write_table, map(Path, out.table), repeat(element_table(rivals, given.heart))))
list(map(write_figure, map(Path, out.figure), repeat(plot_element(case.curves, case.noise, rivals))))
