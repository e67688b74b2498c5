"""Meshes (.vtu) and motions (.npz); a file is read back exactly as it was written, unless the study has a jitter."""

from pathlib import Path
from zipfile import BadZipFile

import meshio
import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.soundness import require_indices, require_sound
from heartfit.geometry.surface import SURFACES
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.io.files import replacing
from heartfit.io.jitter import moved_positions
from heartfit.io.text import parsing, require_file


def read_arrays(path: Path, *names: str) -> dict[str, np.ndarray]:
    """Read arrays by name; raises InputError for a missing or damaged file, or one without a name."""
    expected = f"the arrays {', '.join(names)} in .npz format"
    require_file(path, expected)
    with (
        parsing(path, expected, BadZipFile, OSError),
        Path(path).open("rb") as file,
        np.load(file, allow_pickle=False) as stored,
    ):
        return {name: stored[name] for name in names}


CELL_FIELDS = {"fibres": (3,), "orientation": (6,), "segments": (), "activation": ()}
NO_SURFACE = -1
EXPECTED = "a mesh in .vtu format, as the study builds it"


def write_mesh(path: Path, mesh: VentricularMesh) -> None:
    """Write points [m], tetrahedra with their fields, and triangles with the index of their name in SURFACES."""
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
    """Read a mesh of write_mesh; raises InputError for another file, and for impossible ventricles."""
    require_file(path, EXPECTED)
    with parsing(path, EXPECTED, meshio.ReadError):
        stored = meshio.vtu.read(path)
        if "surface" not in stored.cell_data or not {"tetra", "triangle"} <= set(stored.cells_dict):
            raise InputError(
                f"{path}: expected tetrahedra and triangles with the cell field 'surface'; build it again"
            )
        return _mesh(path, stored)


def read_prepared_mesh(file: Path) -> VentricularMesh:
    """Read a mesh with the fields that a beat needs; raises InputError if one is missing."""
    mesh = read_mesh(file)
    for name in ("fibres", "activation", "segments"):
        if getattr(mesh, name) is None:
            raise InputError(
                f"{file}: no cell field {name}; expected a mesh as the study builds it: build it again"
            )
    return mesh


def _mesh(path: Path, stored: meshio.Mesh) -> VentricularMesh:
    points, tets = moved_positions(stored.points.astype(float)), stored.cells_dict["tetra"].astype(np.int64)
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
    """Write times [s], period [s] and positions [m]."""
    with replacing(path) as draft:
        np.savez_compressed(draft, times=motion.times, period=motion.period, positions=motion.positions)


def read_motion(path: Path) -> Motion:
    """Read a motion of write_motion; raises InputError for a missing file or impossible times."""
    stored = read_arrays(path, "times", "period", "positions")
    return Motion(stored["times"], float(stored["period"]), moved_positions(stored["positions"]))


def write_simulated_motion(path: Path, beat: Beat, times: Floats) -> None:
    """Write the nodal positions of a beat at times (p,) [s] after the trigger; a failed beat has no times."""
    if beat.completed:
        write_motion(path, nodal_motion(beat).resample(times))
        return
    with replacing(path) as draft:
        np.savez_compressed(draft, times=np.empty(0), period=beat.period, positions=np.empty((0, 0, 3)))


def read_simulated_motion(path: Path) -> Motion | None:
    """Read a motion of write_simulated_motion, None of a failed beat; raises InputError for a missing file."""
    return read_motion(path) if len(read_arrays(path, "times")["times"]) else None
