"""Metadata for catalogues and citation managers agree with the project."""

import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def test_the_citation_is_of_this_version_and_licence():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert {"cff-version", "message", "title", "authors"} <= cited.keys()
    assert (str(cited["version"]), cited["license"]) == (PROJECT["version"], PROJECT["license"])


def test_the_shipped_heart_is_cited_under_the_licence_beside_it():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())["references"]
    (data,) = (reference for reference in cited if reference["type"] == "data")
    folder = ROOT / "resources" / "measured_heart"
    assert data["license"] == "Apache-2.0"
    assert "Apache License" in (folder / "LICENSE").read_text().splitlines()[0]
    source = (folder / "README.md").read_text()
    assert data["commit"] in source
    assert data["repository-code"] in source
    address = (ROOT / "workflow" / "rules" / "geometry.smk").read_text()
    assert data["commit"] in address


def test_the_workflow_catalog_finds_its_required_files():
    usage = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    assert {"mandatory-flags", "software-stack-deployment", "report"} <= usage.keys()
    readme = (ROOT / "README.md").read_text().lower()
    assert "snakemake" in readme
    assert "workflow" in readme
    assert (ROOT / "config" / "README.md").is_file()
    assert list(ROOT.glob("workflow/rules/*.smk"))
