"""Meshes as .vtu, readable by ParaView, and motions as .npz; what is written is read back exactly."""

from pathlib import Path

import meshio
import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.geometry.surface import SURFACES
from heartfit.io.atomic import replacing

CELL_FIELDS = {"fibres": (3,), "orientation": (6,), "segments": (), "activation": ()}
NO_SURFACE = -1


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
    """Reads what write_mesh wrote; raises InputError for a missing file or part or inverted tetrahedra."""
    if not path.exists():
        raise InputError(f"{path}: missing; expected a mesh in .vtu format; build it first")
    stored = _stored(path)
    if "surface" not in stored.cell_data or not {"tetra", "triangle"} <= set(stored.cells_dict):
        raise InputError(
            f"{path}: expected tetrahedra and triangles with the cell field 'surface'; build it again"
        )
    triangles, surface_id = stored.cells_dict["triangle"], stored.cell_data_dict["surface"]["triangle"]
    surfaces = {name: triangles[surface_id == i].astype(np.int64) for i, name in enumerate(SURFACES)}
    fields = {name: stored.cell_data_dict[name]["tetra"] for name in CELL_FIELDS if name in stored.cell_data}
    fields["longitudinal"] = stored.point_data.get("longitudinal")
    tets = stored.cells_dict["tetra"].astype(np.int64)
    mesh = VentricularMesh(stored.points.astype(float), tets, surfaces, **fields)
    _require_positive(path, mesh.element_volumes())
    return mesh


def _stored(path: Path) -> meshio.Mesh:
    try:
        return meshio.read(path)
    except (SystemExit, meshio.ReadError):  # meshio leaves the program over a file that it cannot read
        raise InputError(f"{path}: not a mesh in .vtu format; build it again") from None


def _require_positive(path: Path, volumes: Floats) -> None:
    inverted = np.flatnonzero(~(volumes > 0.0))
    if len(inverted):
        raise InputError(
            f"{path}: {len(inverted)} tetrahedra are inverted or flat, first tet {inverted[0]} with "
            f"{volumes[inverted[0]]:.3g} m^3; expected > 0; build the mesh again"
        )


def write_motion(path: Path, motion: Motion) -> None:
    """Writes times and period in s and positions in m."""
    with replacing(path) as draft:
        np.savez_compressed(draft, times=motion.times, period=motion.period, positions=motion.positions)


def read_motion(path: Path) -> Motion:
    """Reads what write_motion wrote; raises InputError for a missing file or times that cannot be."""
    if not path.exists():
        raise InputError(f"{path}: missing; expected a motion in .npz format; register it first")
    with np.load(path) as stored:
        return Motion(stored["times"], float(stored["period"]), stored["positions"])
