"""Stored templates: meshes of the average wall by size, so that virtual hearts need no mesher on any platform.

`python -m benchmarks.templates` makes them anew.
"""

from pathlib import Path

from heartfit.io.meshes import read_mesh
from heartfit.personalise.numerics import MeshSize
from heartfit.synthetic.volunteer import Template

TEMPLATES = Path("resources/templates")
"""Folder of the stored templates, within the working directory."""


def template_file(size: MeshSize, folder: Path = TEMPLATES) -> Path:
    """Return the file of a stored template: edge length and tolerance in mm."""
    return folder / f"{1e3 * size.edge_length:g}_{1e3 * size.tolerance:g}.vtu"


def stored_template(size: MeshSize) -> str | None:
    """Return the file of the template of this size; None if none is stored, and a study has to mesh it."""
    file = template_file(size)
    return file.as_posix() if file.is_file() else None


def find_template(size: MeshSize, folder: Path = TEMPLATES) -> Template:
    """Return the stored template of this size; mesh the average wall if none is stored."""
    file = template_file(size, folder)
    if not file.is_file():
        return Template.build(size.edge_length, size.tolerance)
    return Template(read_mesh(file), size.edge_length, size.tolerance)
