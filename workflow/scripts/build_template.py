"""Mesh the average wall, which is morphed to all virtual hearts."""

from pathlib import Path

from heartfit.io.meshes import write_mesh
from heartfit.io.run import record
from heartfit.synthetic.volunteer import Template

record(snakemake.log[0])
size = snakemake.params.size
write_mesh(Path(snakemake.output[0]), Template.build(size.edge_length, size.tolerance).mesh)
