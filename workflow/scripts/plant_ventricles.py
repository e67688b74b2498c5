"""Hide an effect in three-dimensional ventricles: what was measured and the mesh here, the sealed answer there."""

from pathlib import Path

from heartfit.cohort.template import Template
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.io.planted import write_planted
from heartfit.planting.imaging import Imaging
from heartfit.planting.ventricles import Ventricles

record(snakemake.log[0])
files, out, given = snakemake.input, snakemake.output, snakemake.params
hidden, seen = read_mesh(Path(files.generator)), read_mesh(Path(files.template))
made, carried = given.generator, given.diagnoser.mesh
imaging = Imaging(
    given.scanner, given.registration, Template(seen, carried.edge_length, carried.tolerance), hidden
)
template = Template(hidden, made.mesh.edge_length, made.mesh.tolerance)
ventricles = Ventricles(template, given.standard, made.protocol(given.pressures), imaging)
mesh, case = ventricles.plant(given.plan)
write_mesh(Path(out.mesh), mesh)
write_planted(case, Path(out.measured), Path(out.sealed))
