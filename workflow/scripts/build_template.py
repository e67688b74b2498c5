"""Mesh the average wall once, for all virtual hearts that are moved from it."""

from pathlib import Path

from heartfit.cohort.template import Template
from heartfit.io.log import record
from heartfit.io.meshes import write_mesh

record(snakemake.log[0])
size = snakemake.params.size
write_mesh(Path(snakemake.output[0]), Template.build(size.edge_length, size.tolerance).mesh)
