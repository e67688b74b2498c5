"""Meshes of the same ventricles, stored on disk."""

from pathlib import Path

from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.heart.activation.conduction import assign_activation
from heartfit.io.meshes import read_mesh, write_mesh

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / ".benchmarks"
SHAPE = ParametricVentricles(
    edv=160e-6, wall_thickness=8.5e-3, sphericity=1.85, rv_edv=165e-6, rv_wall_thickness=3.5e-3
)
SIZES = {
    "3k": (16e-3, 0.6e-3),
    "6k": (9e-3, 0.3e-3),
    "10k": (5.6e-3, 0.25e-3),
    "30k": (3.5e-3, 0.25e-3),
    "100k": (2.34e-3, 0.25e-3),
    "400k": (1.44e-3, 0.25e-3),
}
"""Edge length and tolerance [m] by the approximate number of tetrahedra."""


def mesh_file(name: str) -> Path:
    """File of a named mesh, which is generated if it does not exist."""
    path = FOLDER / "meshes" / f"{name}.vtu"
    if not path.exists():
        write_mesh(path, assign_activation(prepare(fill_wall(SHAPE.surface(), *SIZES[name]))))
    return path


def tetrahedra(name: str) -> int:
    """Number of tetrahedra in a mesh."""
    return len(read_mesh(mesh_file(name)).tets)
