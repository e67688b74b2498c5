"""Plant an effect in three-dimensional ventricles; write recording and mesh, and a separate sealed answer."""

from pathlib import Path

from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.io.planting import write_planted
from heartfit.io.run import record
from heartfit.synthetic.ventricles import Imaging, Ventricles
from heartfit.synthetic.volunteer import Template

record(snakemake.log[0])
files, out, params = snakemake.input, snakemake.output, snakemake.params
hidden, observed = read_mesh(Path(files.generator)), read_mesh(Path(files.template))
synthesis, carried = params.generator, params.diagnoser.mesh
imaging = Imaging(
    params.scanner, params.registration, Template(observed, carried.edge_length, carried.tolerance), hidden
)
template = Template(hidden, synthesis.mesh.edge_length, synthesis.mesh.tolerance)
ventricles = Ventricles(template, params.standard, synthesis.protocol(params.pressures), imaging)
imaged, case = ventricles.plant(params.plan)
write_mesh(Path(out.mesh), imaged.mesh)
write_planted(case, Path(out.measured), Path(out.sealed))
