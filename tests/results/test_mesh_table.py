"""Table of the meshes of a study: no bit of a node or of a tetrahedron escapes the hash."""

from dataclasses import replace

import numpy as np

from heartfit.geometry.cube import cube
from heartfit.results.mesh_table import mesh_hash, mesh_table


def test_the_hash_changes_with_one_bit_of_a_node_and_with_the_order_of_tetrahedra() -> None:
    mesh = cube(1, 0.1)
    points = mesh.points.copy()
    points[-1, 2] = np.nextafter(points[-1, 2], 1.0)
    others = [mesh.with_points(points), replace(mesh, tets=mesh.tets[::-1])]
    assert len({mesh_hash(mesh), *map(mesh_hash, others)}) == 3
    assert mesh_hash(cube(1, 0.1)) == mesh_hash(mesh)


def test_a_row_names_the_mesh_and_counts_it() -> None:
    mesh = cube(1, 0.1)
    (row,) = mesh_table({"template coarse": mesh}).to_dict("records")
    assert row == {
        "mesh": "template coarse",
        "nodes": len(mesh.points),
        "tetrahedra": len(mesh.tets),
        "hash": mesh_hash(mesh),
    }
