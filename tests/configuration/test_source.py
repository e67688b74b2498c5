"""What a measured case says of its data: one wall, its labels, and nothing that contradicts."""

import pytest

from heartfit.configuration.source import Labels, Source
from heartfit.configuration.strict import validated
from heartfit.errors import InputError, InputErrors

LABELS = {"lv_cavity": 1, "lv_wall": 2, "rv_cavity": 3}


@pytest.mark.parametrize(
    "content",
    [
        {"fit": "a"},
        {"surfaces": "a", "images": "cine"},
        {"segmentation": "a.nrrd", "labels": LABELS, "images": "cine", "end_diastole": 3},
    ],
)
def test_each_kind_of_wall_is_taken(content):
    source = validated(Source, content, "x.yaml")
    assert source.segmented == ("segmentation" in content)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({}, "no source given for the wall; expected one of fit, surfaces, segmentation"),
        ({"fit": "a", "surfaces": "b"}, "fit and surfaces given"),
        ({"segmentation": "a.nrrd"}, "segmentation and labels go together"),
        ({"segmentation": "a.nrrd", "labels": LABELS}, "images are missing"),
        ({"fit": "a", "labels": LABELS}, "segmentation and labels go together"),
        ({"fit": "a", "end_diastole": 3}, "phase 0 of a fit"),
        ({"fit": "a", "labls": 1}, "did you mean labels"),
        ({"segmentation": "a", "labels": LABELS | {"lv_wall": 1}}, "two labels share a number"),
        ({"segmentation": "a", "labels": {"lv_cavity": 1, "lv_wall": 2}}, "labels.rv_cavity is missing"),
    ],
)
def test_what_is_not_said_or_said_twice_is_refused(content, message):
    with pytest.raises(InputError, match=message):
        validated(Source, content, "x.yaml")


def test_every_mistake_is_kept():
    with pytest.raises(InputErrors) as refused:
        validated(Labels, {"lv_cavity": 0, "wall": 2}, "x.yaml")
    assert len(refused.value.problems) == 4
    assert str(refused.value).count("\n") == 0
    assert "and 3 more" in str(refused.value)
