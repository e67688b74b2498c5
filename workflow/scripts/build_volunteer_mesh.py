"""Mesh the acquired end-diastolic wall of a volunteer for the calibrator, and fit the conduction."""

from pathlib import Path

from heartfit.geometry.fibres import prepare
from heartfit.heart.activation.conduction import CONDUCTIONS, assign_activation, fit_conduction
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.io.run import record
from heartfit.synthetic.volunteer import Template

record(snakemake.log[0])
files, case, size = snakemake.input, snakemake.params.case, snakemake.params.size
acquired, generator = read_mesh(Path(files.outline)), read_mesh(Path(files.generator))
template = Template(read_mesh(Path(files.template)), size.edge_length, size.tolerance)
mesh = prepare(template.fill_wall_of(acquired, generator))
conduction = fit_conduction(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output[0]), assign_activation(mesh, conduction))
