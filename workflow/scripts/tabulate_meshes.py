"""Tabulate the meshes that the study rests on, with their hashes."""

from pathlib import Path

from heartfit.io.meshes import read_mesh
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.results.mesh_table import mesh_table

record(snakemake.log[0])
meshes = {
    name: read_mesh(Path(file)) for name, file in zip(snakemake.params.names, snakemake.input, strict=True)
}
write_csv(Path(snakemake.output[0]), mesh_table(meshes))
