"""The page of file formats names every key of a cause.json and of a posterior, and no other one."""

import re
from dataclasses import fields

import pytest

from heartfit.calibration.update import Posterior
from heartfit.io.causes import CauseFile
from heartfit.io.curves import COLUMNS
from tests.documentation.blocks import ROOT

TEXT = (ROOT / "docs" / "file_formats.md").read_text(encoding="utf-8")


def section(title):
    """Text below a heading of the page, up to the next one."""
    return TEXT.partition(f"## {title}\n")[2].partition("\n## ")[0]


def first_column(text):
    """Names in the first column of the tables of a text."""
    cells = re.findall(r"^\| (`.*?) \|", text, re.MULTILINE)
    return {name for cell in cells for name in re.findall(r"`([\w.]+)`", cell)}


def test_every_key_of_a_cause_is_explained():
    keys = {field.name for field in fields(CauseFile)} - {"fingerprint", "made_by"}
    assert first_column(section("`cause.json`")) == keys


@pytest.mark.parametrize("part", ["fingerprint", "made_by"])
def test_provenance_is_explained_once_for_all_results(part):
    assert f"`{part}`" in TEXT.partition("\n## ")[0]


def test_every_key_of_a_posterior_is_explained():
    named = first_column(section("`posterior.json`, `posterior_noise.json`"))
    summary = {"estimate", "relative_sd", "step", "long_steps"}
    assert {name.split(".")[-1] for name in named} == {field.name for field in fields(Posterior)} | summary


def test_every_column_of_a_recording_is_one_that_is_read():
    rows = re.findall(r"^\| (`\w+`.*?) \| (.*?) \|$", section("Recordings"), re.MULTILINE)
    columns = {
        name + unit
        for names, units in rows
        for name in re.findall(r"`(\w+)`", names)
        for unit in re.findall(r"`(_\w+)`", units)
    }
    assert len(columns) == 10
    assert {column for column in columns if not column.startswith("time")} <= set(COLUMNS)
