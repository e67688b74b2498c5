"""Scales that decide a finding are told, others are not."""

import pytest

from heartfit.discovery.inference.scale_dependence import scale_dependences


@pytest.mark.parametrize(
    ("ranking", "wide", "told"),
    [
        ({"leak": 12.0, "stenosis": 8.0}, 8.9, []),
        (
            {"leak": 12.0, "stenosis": 8.0},
            9.1,
            ["leak (12.0); with 4 times this scale leak (12.0) or stenosis (9.1)"],
        ),
        ({"leak": 12.0, "stenosis": 8.0}, 20.0, ["leak (12.0); with 4 times this scale stenosis (20.0)"]),
        ({"leak": 4.0, "stenosis": 3.0}, 4.9, []),
        ({"leak": 1.0, "stenosis": 3.0}, 6.0, ["nothing; with 4 times this scale stenosis (6.0)"]),
        ({"leak": 1.0, "stenosis": 6.0}, 4.0, ["stenosis (6.0); with 4 times this scale nothing"]),
    ],
    ids=[
        "still apart",
        "not apart",
        "another leads",
        "nothing is detected",
        "now detected",
        "no more detected",
    ],
)
def test_only_a_scale_that_decides_is_told(ranking, wide, told):
    at_scale = {"stenosis": lambda factor: wide if factor > 1.0 else ranking["stenosis"]}
    assert [str(case) for case in scale_dependences(ranking, at_scale, 5.0, apart=3.0)] == told


def test_a_smaller_scale_counts_only_where_it_fits_better():
    """A strong effect is far outside a quarter of its scale, which the data contradict."""
    strong = {"leak": lambda factor: 2.0 if factor < 1.0 else 11.0}
    assert list(scale_dependences({"leak": 12.0}, strong, 5.0)) == []
    (case,) = scale_dependences({"leak": 4.0}, {"leak": lambda factor: 5.2 if factor < 1.0 else 3.0}, 5.0)
    assert str(case) == "nothing; with 0.25 times this scale leak (5.2)"
