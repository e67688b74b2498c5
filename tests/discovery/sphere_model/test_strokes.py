"""Strokes of both ventricles and what their difference says."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.results.cause_card import strokes_sentence

TIMES = 0.8 * np.arange(40) / 40
SHAPE = 0.5 + 0.5 * np.cos(2.0 * np.pi * TIMES / 0.8)


def recorded(right: float) -> Recording:
    """A left stroke of 80 mL, and a right one, with extremes that are means of four frames."""
    curves = {
        "lv_volume": Samples(TIMES, 60e-6 + 80e-6 * SHAPE),
        "rv_volume": Samples(TIMES, 70e-6 + right * SHAPE),
    }
    return Recording(0.8, curves)


def test_the_strokes_are_those_of_the_volumes_and_their_difference_has_the_errors_of_both() -> None:
    strokes = Strokes.from_recording(recorded(80e-6))
    assert strokes is not None
    assert strokes.left == pytest.approx(80e-6, rel=0.03)
    assert strokes.difference == pytest.approx(0.0, abs=1e-12)
    filled = 140e-6
    expected = np.sqrt(2.0 * (0.02 * filled) ** 2 + (0.02 * 150e-6) ** 2 + (0.1 * 80e-6) ** 2)
    assert strokes.sd == pytest.approx(expected, rel=0.03)


def test_without_a_right_volume_there_is_nothing_to_compare() -> None:
    both = recorded(80e-6)
    assert Strokes.from_recording(replace(both, curves={"lv_volume": both.curves["lv_volume"]})) is None


@pytest.mark.parametrize(
    ("right", "words"),
    [
        (76e-6, "within what the volumes err by"),
        (50e-6, "a leak of the mitral or the aortic valve"),
        (120e-6, "a leak of the tricuspid or the pulmonary valve"),
    ],
)
def test_a_clear_difference_may_come_from_a_leak_on_its_side(right: float, words: str) -> None:
    strokes = Strokes.from_recording(recorded(right))
    assert strokes is not None
    assert words in strokes_sentence(strokes)
    assert strokes.differ == ("within" not in words)


@pytest.mark.parametrize(("right", "side"), [(50e-6, "right"), (120e-6, "left")])
def test_a_ventricle_that_is_cut_off_is_no_leak(right: float, side: str) -> None:
    """Volumes do not tell a leak from labels that end below the base, as those of the right ventricle of a pig do."""
    strokes = Strokes.from_recording(recorded(right))
    assert strokes is not None
    sentence = strokes_sentence(strokes)
    assert "Volumes alone do not tell the reason" in sentence
    assert f"a {side} ventricle that images or labels hold incompletely" in sentence
    assert "leaks" not in sentence
