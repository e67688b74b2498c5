"""Table of the meshes that a study rests on: templates, and the meshes of measured hearts.

All that a study computes follows from them, so that a run whose numbers moved is first asked for its meshes.
"""

from collections.abc import Mapping
from hashlib import sha256

import pandas as pd

from heartfit.geometry.mesh import VentricularMesh

DIGITS = 16
"""Hexadecimal digits of a hash that the table shows."""


def mesh_table(meshes: Mapping[str, VentricularMesh]) -> pd.DataFrame:
    """Return one row for each mesh: its name, nodes, tetrahedra, and hash."""
    rows = [(name, len(mesh.points), len(mesh.tets), mesh_hash(mesh)) for name, mesh in meshes.items()]
    return pd.DataFrame(rows, columns=["mesh", "nodes", "tetrahedra", "hash"])


def mesh_hash(mesh: VentricularMesh) -> str:
    """Return the first digits of the SHA-256 of nodes and tetrahedra, every bit of them, without fields."""
    content = mesh.points.astype("<f8").tobytes() + mesh.tets.astype("<i8").tobytes()
    return sha256(content).hexdigest()[:DIGITS]
