"""Verdicts on effects hidden in three dimensions, printed and drawn."""

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.io.figures import write_figure
from heartfit.results.planted_figures import plot_ventricles
from heartfit.results.planted_page import ventricles_page, ventricles_rates
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import DetectableSizes, Scored
from heartfit.synthetic.trial import ScoredDiagnosis
from tests.printed import numbers_in, outside_tables


def scored(seed, planted, verdict, names=()):
    effects = tuple(Effect(name, 2e-5, 0.0, "m^2", 2.5) for name in planted)
    named = tuple(Cause(name, 90.0, 1.5e-5, "m^2", (1e-5, 3e-5)) for name in names)
    answer = Answer(seed, "single" if planted else "none", effects, {}, {}, 0.02)
    return Scored(answer, ScoredDiagnosis(verdict, named, {"Leak": 90.0 if planted else 1.0}, {}, 3000, 20.0))


LEAST = DetectableSizes({("Leak", 1.0): 2.0})
CASES = [
    scored(907, (), "none"),
    scored(908, ("Leak",), "named", ("Leak",)),
    scored(909, ("Leak",), "unknown"),
]


def test_the_page_lists_cases_seeds_and_amplitudes():
    text = outside_tables(ventricles_page(CASES, 2601, LEAST))
    numbers = numbers_in(text)
    assert {3.0, 2601.0, 907.0, 909.0} <= set(numbers)
    assert 2602.0 in numbers_in(ventricles_page(CASES, 2602, LEAST))
    (amplitudes,) = [line for line in text.splitlines() if 0.75 in numbers_in(line)]
    assert numbers_in(amplitudes)[-7:] == [0.75, 1.0, 0.75, 0.75, 95.0, 1.0, 1.0]


def test_only_effects_above_their_limit_count_against_the_target():
    below = DetectableSizes({("Leak", 1.0): 3.0})
    rates = ventricles_rates(CASES, LEAST).set_index("rate")
    assert rates.loc["singles above their limit, named right", "count"] == "1 of 2"
    assert "singles above their limit, named right" not in set(ventricles_rates(CASES, below)["rate"])
    assert "| 2.0 " in ventricles_page(CASES, 26, LEAST)


def test_without_a_right_name_there_is_no_amplitude():
    page = ventricles_page(CASES[:1], 1, LEAST)
    assert 0.75 not in numbers_in(page)
    assert "nan" not in outside_tables(page)


def test_the_figure_is_drawn(tmp_path):
    write_figure(tmp_path / "figure.png", plot_ventricles(CASES))
    assert (tmp_path / "figure.png").stat().st_size > 5_000
