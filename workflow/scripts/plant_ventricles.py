"""Hide an effect in three-dimensional ventricles: what was measured and the wall here, the sealed answer there."""

from pathlib import Path

from heartfit.cohort.template import Template
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.io.planted import write_planted
from heartfit.planting.ventricles import Ventricles

record(snakemake.log[0])
given, size = snakemake.params, snakemake.params.generator.mesh
template = Template(read_mesh(Path(snakemake.input.template)), size.edge_length, size.tolerance)
ventricles = Ventricles(template, given.standard, given.generator.protocol(given.pressures))
wall, case = ventricles.plant(given.plan)
write_mesh(Path(snakemake.output.wall), wall)
write_planted(case, Path(snakemake.output.measured), Path(snakemake.output.sealed))
