"""Data declared by a measured case: one wall, its labels, and no contradictions."""

import pytest

from heartfit.core.errors import InputError, InputErrors
from heartfit.core.validation import validate
from heartfit.study.case import Labels, Source

LABELS = {"lv_cavity": 1, "lv_wall": 2, "rv_cavity": 3}


@pytest.mark.parametrize(
    "content",
    [
        {"fit": "a"},
        {"surfaces": "a", "images": "cine"},
        {"segmentation": "a.nrrd", "labels": LABELS, "images": "cine", "end_diastole": 3},
    ],
)
def test_each_kind_of_wall_is_accepted(content):
    source = validate(Source, content, "x.yaml")
    assert source.segmented == ("segmentation" in content)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({}, "fit, surfaces, segmentation"),
        ({"fit": "a", "surfaces": "b"}, "fit and surfaces"),
        ({"segmentation": "a.nrrd"}, "segmentation.*labels"),
        ({"segmentation": "a.nrrd", "labels": LABELS}, "images"),
        ({"fit": "a", "labels": LABELS}, "segmentation.*labels"),
        ({"fit": "a", "end_diastole": 3}, "end_diastole|phase 0"),
        ({"fit": "a", "labls": 1}, "labls.*labels"),
        ({"segmentation": "a", "labels": LABELS | {"lv_wall": 1}}, "labels.*number"),
        ({"segmentation": "a", "labels": {"lv_cavity": 1, "lv_wall": 2}}, "labels.rv_cavity"),
    ],
)
def test_missing_and_repeated_statements_are_refused(content, message):
    with pytest.raises(InputError, match=message):
        validate(Source, content, "x.yaml")


def test_every_mistake_is_kept():
    with pytest.raises(InputErrors) as refused:
        validate(Labels, {"lv_cavity": 0, "wall": 2}, "x.yaml")
    assert len(refused.value.problems) == 4
    assert str(refused.value).count("\n") == 0
    assert "and 3 more" in str(refused.value)
