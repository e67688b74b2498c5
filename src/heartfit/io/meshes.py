"""Meshes as .vtu, readable by ParaView, and motions as .npz; what is written is read back exactly."""

from pathlib import Path

import meshio
import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.geometry.soundness import require_indices, require_sound
from heartfit.geometry.surface import SURFACES
from heartfit.io.arrays import read_arrays
from heartfit.io.atomic import replacing
from heartfit.io.foreign import parsing
from heartfit.io.text import require_file

CELL_FIELDS = {"fibres": (3,), "orientation": (6,), "segments": (), "activation": ()}
NO_SURFACE = -1
EXPECTED = "a mesh in .vtu format, as the study builds it"


def write_mesh(path: Path, mesh: VentricularMesh) -> None:
    """Writes points in m, tets with their fields, and triangles with the index of their name in SURFACES."""
    triangles = [mesh.surfaces[name] for name in SURFACES]
    surface_id = np.repeat(np.arange(len(SURFACES)), [len(part) for part in triangles])
    cells = [("tetra", mesh.tets), ("triangle", np.vstack(triangles))]
    cell_data = {"surface": [np.full(len(mesh.tets), NO_SURFACE), surface_id]}
    for name, shape in CELL_FIELDS.items():
        field = getattr(mesh, name)
        if field is not None:
            cell_data[name] = [field, np.zeros((len(surface_id), *shape), field.dtype)]
    point_data = {} if mesh.longitudinal is None else {"longitudinal": mesh.longitudinal}
    with replacing(path) as draft:
        meshio.Mesh(mesh.points, cells, point_data=point_data, cell_data=cell_data).write(draft)


def read_mesh(path: Path) -> VentricularMesh:
    """Reads what write_mesh wrote; raises InputError for what is no such file, and for ventricles that cannot be."""
    require_file(path, EXPECTED)
    with parsing(path, EXPECTED, meshio.ReadError):
        stored = meshio.vtu.read(path)
        if "surface" not in stored.cell_data or not {"tetra", "triangle"} <= set(stored.cells_dict):
            raise InputError(
                f"{path}: expected tetrahedra and triangles with the cell field 'surface'; build it again"
            )
        return _mesh(path, stored)


def read_prepared_mesh(file: Path) -> VentricularMesh:
    """A mesh with the fields that a beat needs; raises InputError where one is missing."""
    mesh = read_mesh(file)
    for name in ("fibres", "activation", "segments"):
        if getattr(mesh, name) is None:
            raise InputError(
                f"{file}: no cell field {name}; expected a mesh as the study builds it: build it again"
            )
    return mesh


def _mesh(path: Path, stored: meshio.Mesh) -> VentricularMesh:
    points, tets = stored.points.astype(float), stored.cells_dict["tetra"].astype(np.int64)
    triangles, surface_id = stored.cells_dict["triangle"], stored.cell_data_dict["surface"]["triangle"]
    surfaces = {name: triangles[surface_id == i].astype(np.int64) for i, name in enumerate(SURFACES)}
    fields = {name: stored.cell_data_dict[name]["tetra"] for name in CELL_FIELDS if name in stored.cell_data}
    fields["longitudinal"] = stored.point_data.get("longitudinal")
    try:
        require_indices(points, tets, triangles)
        mesh = VentricularMesh(points, tets, surfaces, **fields)
        require_sound(mesh)
    except InputError as fault:
        raise InputError(f"{path}: {fault}") from None
    return mesh


def write_motion(path: Path, motion: Motion) -> None:
    """Writes times and period in s and positions in m."""
    with replacing(path) as draft:
        np.savez_compressed(draft, times=motion.times, period=motion.period, positions=motion.positions)


def read_motion(path: Path) -> Motion:
    """Reads what write_motion wrote; raises InputError for a missing file or times that cannot be."""
    stored = read_arrays(path, "times", "period", "positions")
    return Motion(stored["times"], float(stored["period"]), stored["positions"])
