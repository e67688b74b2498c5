"""Test whether linear tetrahedra, a mechanism or the locking-free element explains a heart on a finer mesh."""

from pathlib import Path

from heartfit.discovery.refit.model import Model
from heartfit.heart.heart import Heart
from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_mesh
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.element import element_table, plot_element
from heartfit.results.text import render_table
from heartfit.synthetic.element import compare_extensions, competing_extensions, hidden_case
from heartfit.synthetic.volunteer import Template

record(snakemake.log[0])
files, out, params = snakemake.input, snakemake.output, snakemake.params
question, size = params.question, params.size
fine, coarse = read_mesh(Path(files.generator)), read_mesh(Path(files.template))
heart = Heart(period=question.period).with_parameters(params.heart)
template = Template(coarse, size.edge_length, size.tolerance)
case, mesh = hidden_case(fine, template, heart, params.pressures, params.scheme, question.seed)
model = Model(mesh, question.period, params.pressures, params.scheme)
rivals = compare_extensions(
    case, model, competing_extensions(params.setting, question.element, question.mechanism), params.steps
)
table = render_table(element_table(rivals, params.heart))
for file in out.table:
    write_table(Path(file), table)
figure = plot_element(case.curves, case.noise, rivals)
for file in out.figure:
    write_figure(Path(file), figure)
