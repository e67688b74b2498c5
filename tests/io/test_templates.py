"""Stored templates: every size of the study has one, the mesh behind the stored tables; the mesher gives it again."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.templates import ROOT, sizes
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh
from heartfit.io.templates import TEMPLATES, find_template, stored_template, template_file
from heartfit.personalise.numerics import MeshSize
from heartfit.results.mesh_table import mesh_hash
from heartfit.study.study import Study
from heartfit.synthetic.volunteer import Template

REFERENCES = {"study": "full", "full": "full", "smoke": "smoke", "normal": "normal"}
"""Configuration by folder of stored tables."""


def study_of(configuration: str) -> Study:
    return read_study([ROOT / "config" / f"{name}.yaml" for name in ("config", configuration)])


def stored(size: MeshSize) -> Path:
    return template_file(size, ROOT / TEMPLATES)


def test_every_size_of_a_configuration_is_stored_and_no_other() -> None:
    assert sorted(map(stored, sizes())) == sorted((ROOT / TEMPLATES).iterdir())


@pytest.mark.parametrize("reference", REFERENCES)
def test_a_stored_template_is_the_mesh_behind_the_stored_tables(reference: str) -> None:
    templates = study_of(REFERENCES[reference]).templates()
    table = pd.read_csv(ROOT / "resources" / "reference" / reference / "meshes.csv")
    hashes = dict(zip(table["mesh"], table["hash"], strict=True))
    uses = [name.removeprefix("template ") for name in hashes if name.startswith("template ")]
    assert len(uses) >= 2
    assert {use: mesh_hash(read_mesh(stored(templates[use]))) for use in uses} == {
        use: hashes[f"template {use}"] for use in uses
    }


def test_another_size_is_not_stored_and_is_meshed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    other = MeshSize(edge_length=0.025, tolerance=0.0018)
    monkeypatch.setattr(Template, "build", lambda *size: size)
    assert stored_template(other) is None
    assert find_template(other) == (0.025, 0.0018)
    (size, *_) = sizes()
    assert stored_template(size) == "resources/templates/7.8_0.3.vtu"
    assert find_template(size).edge_length == 0.0078


@pytest.mark.long
@pytest.mark.parametrize("size", sizes(), ids=lambda size: stored(size).stem)
def test_the_mesher_gives_the_stored_template(size: MeshSize) -> None:
    meshed, kept = Template.build(size.edge_length, size.tolerance).mesh, read_mesh(stored(size))
    np.testing.assert_array_equal(meshed.points, kept.points)
    np.testing.assert_array_equal(meshed.tets, kept.tets)
    for name, faces in meshed.surfaces.items():
        np.testing.assert_array_equal(faces, kept.surfaces[name])
