"""Who may know whom, read from the syntax tree."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "src" / "heartfit"
FILES = sorted(PACKAGE.rglob("*.py"))

# a layer may import itself, what stands below it in this list, and nothing above; one line, one height
HEIGHTS = (
    ("compiled", "errors", "planning"),
    ("parameter",),
    ("geometry",),
    ("branch", "imaging", "load", "periodic"),
    ("segmentation",),
    ("electrophysiology",),
    ("mechanism",),
    ("mechanics",),
    ("circulation",),
    ("mechanisms",),
    ("heart",),
    ("beat", "limit_cycle", "registration", "ventricles"),
    ("simulation",),
    ("sphere",),
    ("cohort",),
    ("observation",),
    ("spherical_case",),
    ("verification",),
    ("kernels",),
    ("calibration", "discovery"),
    ("diagnosis", "sensitivity", "twins"),
    ("planting",),
    ("tables",),
    ("exchange",),
    ("report",),
    ("catalogue",),
    ("configuration",),
    ("protocol",),
    ("proof",),
    ("verification",),
    ("kernels",),
    ("console",),
    ("io",),
    ("commands",),
    ("cli",),
)
HEIGHT = {layer: height for height, layers in enumerate(HEIGHTS) for layer in layers}
PHYSICS = {"geometry", "electrophysiology", "mechanics", "mechanism", "mechanisms", "circulation", "heart"}
PHYSICS |= {
    "branch",
    "imaging",
    "segmentation",
    "periodic",
    "simulation",
    "sphere",
    "limit_cycle",
    "beat",
    "cohort",
    "registration",
    "observation",
    "proof",
    "calibration",
    "discovery",
    "diagnosis",
    "planning",
    "planting",
    "twins",
    "sensitivity",
    "spherical_case",
    "verification",
}
HEART = {
    "branch",
    "heart",
    "mechanism",
    "mechanisms",
    "mechanics",
    "circulation",
    "electrophysiology",
    "simulation",
    "sphere",
    "limit_cycle",
    "io",
}
FORBIDDEN_TO_PHYSICS = {
    "logging",
    "pathlib",
    "snakemake",
    "json",
    "csv",
    "yaml",
    "pandas",
    "meshio",
    "shutil",
}


def layer(file: Path) -> str:
    return file.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imports(file: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
    return found


def layers_imported(file: Path) -> set[str]:
    parts = [name.split(".") for name in imports(file) if name.split(".")[0] == "heartfit"]
    return {part[1] for part in parts if len(part) > 1}


def test_every_layer_has_its_place():
    assert {layer(file) for file in FILES} - {"__init__"} == set(HEIGHT)


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_imports_point_downwards(file):
    own = layer(file)
    others = layers_imported(file) - {own}
    upward = sorted(other for other in others if own in HEIGHT and HEIGHT[other] >= HEIGHT[own])
    assert not upward, f"{own} may not import {upward}"


def test_what_knows_vectors_never_imports_a_heart():
    for file in FILES:
        if layer(file) in {"calibration", "discovery", "sensitivity"}:
            assert not layers_imported(file) & HEART, file


def test_physics_knows_no_file_and_no_workflow():
    for file in FILES:
        if layer(file) in PHYSICS:
            assert not {name.split(".")[0] for name in imports(file)} & FORBIDDEN_TO_PHYSICS, file


def test_only_io_and_the_command_line_open_files():
    opening = {"open", "read_text", "write_text", "read_bytes", "write_bytes", "loadtxt", "savez", "read_csv"}
    for file in FILES:
        if layer(file) not in {"io", "commands"}:
            calls = [
                node.func for node in ast.walk(ast.parse(file.read_text())) if isinstance(node, ast.Call)
            ]
            names = {
                call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "") for call in calls
            }
            allowed = {"open"} if file.name == "tetrahedra.py" else set()  # os.open of the null device
            assert not names & opening - allowed, file


def test_only_scripts_and_the_command_line_call_io():
    for file in FILES:
        if layer(file) not in {"io", "commands", "cli"}:
            assert "io" not in layers_imported(file), file


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_files_and_functions_are_short(file):
    text = file.read_text()
    assert text.count("\n") <= 300
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno <= 50, node.name


def test_there_is_no_drawer_for_everything():
    assert not [file for file in FILES if file.stem in {"utils", "helpers", "common", "misc"}]
