"""Mesh the average wall anew in every size that a configuration names; writes resources/templates, a minute.

python -m benchmarks.templates

The meshes of config/fine.yaml, of 20k tetrahedra, are left to the studies that need them.
"""

import sys
from pathlib import Path

from benchmarks.ventricles import ROOT
from heartfit.io.configuration import read_study
from heartfit.io.meshes import write_mesh
from heartfit.io.templates import TEMPLATES, template_file
from heartfit.personalise.numerics import MeshSize
from heartfit.synthetic.volunteer import Template

CONFIGURATION = ROOT / "config" / "config.yaml"
NOT_STORED = ("fine",)
"""Configurations whose templates are not stored."""


def main() -> int:
    for size in sizes():
        file = template_file(size, ROOT / TEMPLATES)
        mesh = Template.build(size.edge_length, size.tolerance).mesh
        write_mesh(file, mesh)
        sys.stdout.write(f"{file.name}: {len(mesh.points)} nodes, {len(mesh.tets)} tetrahedra\n")
    return 0


def sizes() -> list[MeshSize]:
    """Sizes of the templates of every configuration, the finest first."""
    named = {
        size for path in configurations() for size in read_study([CONFIGURATION, path]).templates().values()
    }
    return sorted(named, key=lambda size: (size.edge_length, size.tolerance))


def configurations() -> list[Path]:
    """Configurations whose templates are stored."""
    files = sorted(CONFIGURATION.parent.glob("*.yaml"))
    return [file for file in files if file.stem not in NOT_STORED]


if __name__ == "__main__":
    sys.exit(main())
