"""The rooms of the package and the arrows between them, read from the syntax trees of the sources."""

import ast
from pathlib import Path

import pytest

from tests.sources import PACKAGE, nodes, trees_below

ROOMS = (
    "core",
    "geometry",
    "roles",
    "mechanisms",
    "places",
    "heart",
    "imaging",
    "calibration",
    "observation",
    "personalise",
    "discovery",
    "synthetic",
    "study",
    "results",
    "io",
    "api",
    "cli",
)
"""A room may import itself and what stands above it in this list."""

PHYSICS = {"geometry", "roles", "mechanisms", "heart", "imaging", "observation", "calibration", "discovery"}
PHYSICS |= {"synthetic", "places"}
VECTORS = ("calibration", "discovery/inference")
"""Folders that know parameters and observations as vectors, and no heart."""

VECTOR_IMPORTS = {"core", "calibration", "discovery.inference"}
FILE_LIBRARIES = {"logging", "pathlib", "snakemake", "json", "csv", "yaml", "pandas", "meshio", "shutil"}
FILE_CALLS = {"open", "read_text", "write_text", "read_bytes", "write_bytes", "loadtxt", "savez", "read_csv"}
ALLOWED_CALLS = {
    ("geometry/tetrahedra.py", "open"),  # os.open of the null device
    ("__init__.py", "read_text"),  # the list of public names
    ("core/kernel_cache.py", "read_bytes"),  # the sources of the package, before io can be imported
}
CATCH_ALLS = {"utils", "helpers", "common", "misc"}
LONGEST_FILE, LONGEST_FUNCTION = 300, 50


@pytest.fixture(scope="module")
def trees() -> dict[str, ast.Module]:
    """Syntax trees of the package by file."""
    return trees_below(PACKAGE)


def room_of(file: str) -> str:
    return file.split("/")[0].removesuffix(".py")


def imported_modules(tree: ast.AST) -> set[str]:
    """Dotted names of all modules that a source imports, wherever the statement stands."""
    modules = set()
    for node in nodes(tree):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            own = node.module == "heartfit"
            modules |= {f"heartfit.{alias.name}" for alias in node.names} if own else {node.module}
    return modules


def imported_rooms(tree: ast.AST) -> set[str]:
    return {module.split(".")[1] for module in imported_modules(tree) if module.startswith("heartfit.")}


def names_called(tree: ast.AST) -> set[str]:
    calls = [node.func for node in nodes(tree) if isinstance(node, ast.Call)]
    return {call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "") for call in calls}


def test_every_room_has_its_place(trees):
    assert {room_of(file) for file in trees} - {"__init__"} == set(ROOMS)


def test_imports_point_to_lower_rooms(trees):
    upward = [
        (file, room)
        for file, tree in trees.items()
        for room in imported_rooms(tree) - {room_of(file)}
        if file != "__init__.py" and ROOMS.index(room) >= ROOMS.index(room_of(file))
    ]
    assert not upward


def test_rooms_of_vectors_never_import_a_heart(trees):
    others = [
        (file, module)
        for file, tree in trees.items()
        if file.startswith(VECTORS)
        for module in imported_modules(tree)
        if module.startswith("heartfit.")
        and not any(module.removeprefix("heartfit.").startswith(allowed) for allowed in VECTOR_IMPORTS)
    ]
    assert not others


def test_physics_knows_no_file_and_no_workflow(trees):
    offenders = [
        (file, module)
        for file, tree in trees.items()
        if room_of(file) in PHYSICS
        for module in imported_modules(tree)
        if module.split(".")[0] in FILE_LIBRARIES
    ]
    assert not offenders


def test_only_io_and_the_command_line_open_files(trees):
    offenders = {
        (file, name)
        for file, tree in trees.items()
        if room_of(file) not in {"io", "cli"}
        for name in names_called(tree) & FILE_CALLS
    }
    assert offenders == ALLOWED_CALLS


def test_io_imports_records_of_results_and_no_function(trees):
    functions = {
        (file, alias.name)
        for file, tree in trees.items()
        if room_of(file) == "io"
        for node in nodes(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("heartfit.results")
        for alias in node.names
        if not alias.name[0].isupper()
    }
    assert not functions


def test_files_and_functions_are_short(trees):
    long_files = [file for file in trees if (PACKAGE / file).read_text().count("\n") > LONGEST_FILE]
    long_functions = [
        (file, node.name)
        for file, tree in trees.items()
        for node in nodes(tree)
        if isinstance(node, ast.FunctionDef) and node.end_lineno - node.lineno > LONGEST_FUNCTION
    ]
    assert not long_files + long_functions


def test_no_file_is_a_catch_all(trees):
    assert not [file for file in trees if Path(file).stem in CATCH_ALLS]


def test_no_class_name_stands_for_two_concepts(trees):
    places: dict[str, list[str]] = {}
    for file, tree in trees.items():
        for node in nodes(tree):
            if isinstance(node, ast.ClassDef):
                places.setdefault(node.name, []).append(file)
    assert not {name: files for name, files in places.items() if len(files) > 1}
