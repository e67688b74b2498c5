"""Adults drawn from normal values: published means and spreads, by seed, and the table of the second cohort."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.normal_adults import (
    LEFT_VOLUME,
    RIGHT_VOLUME,
    SEXES,
    THINNEST,
    WALL,
    NormalAdult,
    abnormal,
    draw_adult,
)
from heartfit.calibration.plausible import Limit
from heartfit.heart.beat import Beat
from heartfit.io.configuration import read_cases
from heartfit.synthetic.volunteer import ESTIMATED_SPREAD

CONFIG = Path(__file__).parents[2] / "config"


@pytest.fixture(scope="module")
def adults() -> list[NormalAdult]:
    return [draw_adult(seed) for seed in range(3000)]


@pytest.mark.parametrize("sex", SEXES)
def test_volumes_and_walls_have_the_published_means_and_spreads(adults: list[NormalAdult], sex: str) -> None:
    shapes = [adult.anatomy.shape for adult in adults if adult.sex == sex]
    assert len(shapes) == pytest.approx(1500, abs=120)
    for values, (mean, sd) in (
        ([shape.edv for shape in shapes], LEFT_VOLUME[sex]),
        ([shape.rv_edv for shape in shapes], RIGHT_VOLUME[sex]),
    ):
        assert np.mean(values) == pytest.approx(mean, abs=0.1 * sd)
        assert np.std(values) == pytest.approx(sd, rel=0.1)
    walls = np.array([shape.wall_thickness for shape in shapes])
    assert walls.mean() == pytest.approx(WALL[sex][0], abs=0.2 * WALL[sex][1])
    assert walls.min() >= THINNEST


def test_both_ventricles_grow_together_and_parameters_scatter_about_one(adults: list[NormalAdult]) -> None:
    men = [adult for adult in adults if adult.sex == "man"]
    volumes = np.array([(adult.anatomy.shape.edv, adult.anatomy.shape.rv_edv) for adult in men])
    assert np.corrcoef(volumes.T)[0, 1] == pytest.approx(0.8, abs=0.04)
    logarithms = np.log([adult.ratios["sigma_0"] for adult in adults])
    assert logarithms.mean() == pytest.approx(0.0, abs=0.01)
    assert logarithms.std() == pytest.approx(ESTIMATED_SPREAD, rel=0.1)


def test_a_seed_draws_the_same_adult() -> None:
    assert draw_adult(7) == draw_adult(7)
    assert draw_adult(7) != draw_adult(8)


def test_the_second_cohort_is_what_its_seeds_draw() -> None:
    cases = read_cases(CONFIG / "normal_cases.tsv")
    volunteers = [case for case in cases if case.healthy]
    assert len(volunteers) == 7
    for case in volunteers:
        adult = draw_adult(case.seed or 0)
        shape, drawn = case.shape(), adult.anatomy.shape
        assert (shape.edv, shape.rv_edv) == pytest.approx((drawn.edv, drawn.rv_edv)), case.case
        assert (shape.wall_thickness, shape.sphericity) == pytest.approx(
            (drawn.wall_thickness, drawn.sphericity)
        )
        assert case.period == pytest.approx(adult.anatomy.period)
        assert case.hidden == pytest.approx(adult.ratios)


def test_the_patients_of_both_cohorts_are_the_same() -> None:
    first, second = (
        [case for case in read_cases(CONFIG / name) if not case.healthy]
        for name in ("cases.tsv", "normal_cases.tsv")
    )
    assert first == second


def test_an_abnormal_beat_names_its_limits() -> None:
    time = np.linspace(0.0, 0.8, 81)
    volume = 1e-4 * (1.0 + 0.25 * np.cos(2.0 * np.pi * time / 0.8))
    pressure = 6e3 * (1.0 - np.cos(2.0 * np.pi * time / 0.8))
    beat = Beat(time, {"lv": volume, "rv": volume}, {"lv": pressure}, {}, 0.8, 0.0)
    limits = [Limit("EF", 0.48, 0.71), Limit("ESV", 18e-6, 82e-6), Limit("P_max", 11e3, 19e3)]
    assert abnormal(beat, limits) == ["EF"]
    assert abnormal(beat, [Limit("EF", 0.3, 0.5), Limit("P_max", 13e3, 19e3)]) == ["P_max"]
