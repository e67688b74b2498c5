"""Fill the wall of a volunteer, as acquired at end diastole, with a mesh and a conduction of the calibrator's own."""

from pathlib import Path

from heartfit.cohort.template import Template
from heartfit.electrophysiology.conduction import CONDUCTIONS
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.geometry.prepare import prepare
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh

record(snakemake.log[0])
files, case, size = snakemake.input, snakemake.params.case, snakemake.params.size
acquired, generator = read_mesh(Path(files.outline)), read_mesh(Path(files.generator))
template = Template(read_mesh(Path(files.template)), size.edge_length, size.tolerance)
mesh = prepare(template.refilling(acquired, generator))
conduction = personalised(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output[0]), assign_activation(mesh, conduction))
