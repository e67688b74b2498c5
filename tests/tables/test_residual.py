"""Residuals as table, sentence and figure; a beat that failed says so."""

import numpy as np
import pytest

from heartfit.observation.beat_phases import BeatPhases
from heartfit.observation.residual import CaseResidual, Misfit, Residual
from heartfit.observation.strain import DIRECTIONS
from heartfit.observation.strain_residual import StrainResidual
from heartfit.tables.residual_figure import CONVERGED, ONE_STEP, plot_residual
from heartfit.tables.residual_table import residual_table, segment_sentence, sentence

TIMES = 0.08 * np.arange(10)
PHASES = BeatPhases(np.array([0.0, 0.06, 0.3, 0.36, 0.55, 0.65]), 0.8)
VOLUME = Residual(
    "lv_volume",
    TIMES,
    np.full(10, 100e-6),
    np.full(10, 2e-6),
    {ONE_STEP: np.full(10, 110e-6), CONVERGED: np.full(10, 96e-6)},
)
STRAIN = StrainResidual(0.3, np.full((3, 16), 0.02), np.full((3, 16), 0.01))
FOUND = CaseResidual([VOLUME], PHASES, STRAIN)


def test_one_row_per_sample_and_beat_and_one_per_segment_and_direction() -> None:
    table = residual_table(FOUND)
    assert len(table) == 2 * 10 + 3 * 16
    last = table[(table.curve == "lv_volume") & (table.beat == CONVERGED)]
    assert last.difference.tolist() == pytest.approx([-4.0] * 10)
    assert last.score.tolist() == pytest.approx([-2.0] * 10)
    assert table[table.unit == "%"].score.tolist() == pytest.approx([2.0] * 48)


def test_the_sentence_says_which_curve_when_and_which_sign() -> None:
    assert sentence(Misfit("lv_pressure", "ejection", 512.0, 3.21)) == (
        "LV pressure in ejection: simulated 0.5 kPa too large (3.2 times its noise)"
    )


def test_a_segment_is_named_with_its_sign() -> None:
    difference = np.zeros((3, 16))
    difference[DIRECTIONS.index("circumferential"), 15] = -0.1
    expected = "segment 16, apical lateral, shortens too much by 10 % of its length"
    assert segment_sentence(StrainResidual(0.3, difference, None)) == expected
    noisy = StrainResidual(0.3, -difference, np.full((3, 16), 0.05))
    assert segment_sentence(noisy) == f"{expected.replace('much', 'little')} (2.0 times its noise)"


def test_the_figure_has_a_strip_per_curve_and_names_the_worst() -> None:
    figure = plot_residual(FOUND, "volunteer1, physical setting")
    assert "simulated 4.0 mL too small" in figure.get_suptitle()
    assert "segment 1, basal anterior, shortens too little by 2 %" in figure.get_suptitle()
    assert "may be physics" in figure.get_supxlabel()
    lines = figure.subfigs[0].axes[0].get_lines()
    assert {line.get_label() for line in lines} >= {ONE_STEP, CONVERGED}


def test_a_beat_that_failed_is_said_so() -> None:
    nothing = CaseResidual((), None, None)
    assert residual_table(nothing).empty
    assert "no beat was completed" in plot_residual(nothing, "volunteer1").get_suptitle()
