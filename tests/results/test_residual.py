"""Residuals as table, sentence and figure; a failed beat is reported."""

import numpy as np
import pytest

from heartfit.observation.beat import BeatPhases
from heartfit.observation.residual import CaseResidual, Misfit, Residual, StrainResidual
from heartfit.observation.strain import DIRECTIONS
from heartfit.results.colours import SETTING_COLOURS
from heartfit.results.residual import (
    CAUTION,
    CONVERGED,
    CURVE_LABELS,
    ONE_STEP,
    SEGMENT_NAMES,
    misfit_sentence,
    plot_residual,
    residual_table,
    segment_misfit_sentence,
)
from tests.printed import numbers_in

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
RESIDUAL = CaseResidual([VOLUME], PHASES, STRAIN)


def test_one_row_per_sample_and_beat_and_one_per_segment_and_direction() -> None:
    table = residual_table(RESIDUAL)
    assert len(table) == 2 * 10 + 3 * 16
    last = table[(table.curve == "lv_volume") & (table.beat == CONVERGED)]
    assert last.difference.tolist() == pytest.approx([-4.0] * 10)
    assert last.score.tolist() == pytest.approx([-2.0] * 10)
    assert table[table.unit == "%"].score.tolist() == pytest.approx([2.0] * 48)


def test_the_sentence_names_curve_phase_and_sign() -> None:
    larger, smaller = (
        misfit_sentence(Misfit("lv_pressure", "ejection", sign * 512.0, sign * 3.21)) for sign in (1, -1)
    )
    assert [part for part in (CURVE_LABELS["lv_pressure"], "ejection", "kPa") if part not in larger] == []
    assert numbers_in(larger) == numbers_in(smaller) == [0.5, 3.2]
    assert larger != smaller


def test_a_segment_is_named_with_its_sign() -> None:
    difference = np.zeros((3, 16))
    difference[DIRECTIONS.index("circumferential"), 15] = -0.1
    much, little = (segment_misfit_sentence(StrainResidual(0.3, sign * difference, None)) for sign in (1, -1))
    assert SEGMENT_NAMES[15] in much
    assert numbers_in(much) == numbers_in(little) == [16.0, 10.0]
    assert much != little
    noisy = StrainResidual(0.3, -difference, np.full((3, 16), 0.05))
    assert numbers_in(segment_misfit_sentence(noisy)) == [16.0, 10.0, 2.0]


def test_the_figure_has_a_strip_per_curve_and_names_the_worst() -> None:
    figure = plot_residual(RESIDUAL, "volunteer1, physical setting", SETTING_COLOURS[0])
    assert misfit_sentence(RESIDUAL.misfits()[0]) in figure.get_suptitle()
    assert segment_misfit_sentence(STRAIN) in figure.get_suptitle()
    assert numbers_in(figure.get_suptitle().replace("volunteer1", "")) == [4.0, 2.0, 1.0, 2.0, 2.0]
    assert figure.get_supxlabel() == CAUTION
    lines = figure.subfigs[0].axes[0].get_lines()
    assert {line.get_label() for line in lines} >= {ONE_STEP, CONVERGED}


def test_a_failed_beat_is_reported() -> None:
    nothing = CaseResidual((), None, None)
    assert residual_table(nothing).empty
    figure = plot_residual(nothing, "volunteer1", SETTING_COLOURS[0])
    assert not figure.axes
    assert figure.get_suptitle().startswith("volunteer1")
    assert figure.get_suptitle() != "volunteer1"
