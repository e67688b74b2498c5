"""What was said of effects hidden in three dimensions, printed and drawn."""

from heartfit.diagnosis.cause import Cause
from heartfit.io.tables import write_figure
from heartfit.planting.case import Answer
from heartfit.planting.effects import Effect
from heartfit.planting.least import Least
from heartfit.planting.scoring import Scored
from heartfit.planting.trial import Finding
from heartfit.tables.planted_ventricles import ventricles_page, ventricles_rates
from heartfit.tables.planted_ventricles_figure import plot_ventricles


def scored(seed, planted, verdict, said=()):
    effects = tuple(Effect(name, 2e-5, 0.0, "m^2", 2.5) for name in planted)
    named = tuple(Cause(name, 90.0, 1.5e-5, "m^2", (1e-5, 3e-5)) for name in said)
    answer = Answer(seed, "single" if planted else "none", effects, {}, {}, 0.02)
    return Scored(answer, Finding(verdict, named, {"Leak": 90.0 if planted else 1.0}, {}, 3000, 20.0))


LEAST = Least({("Leak", 1.0): 2.0})
CASES = [scored(7, (), "none"), scored(8, ("Leak",), "named", ("Leak",)), scored(9, ("Leak",), "unknown")]


def test_the_page_tells_cases_seeds_and_amplitudes():
    page = ventricles_page(CASES, 26, LEAST)
    assert "3 biventricular hearts, of 26 planned" in page
    assert "(7 to 9)" in page
    assert "0.75 of the planted one" in page
    assert "in 1 of 1" in page


def test_only_effects_above_their_limit_count_against_the_target():
    below = Least({("Leak", 1.0): 3.0})
    said = ventricles_rates(CASES, LEAST).set_index("rate")
    assert said.loc["singles above their limit, named right", "count"] == "1 of 2"
    assert "singles above their limit, named right" not in set(ventricles_rates(CASES, below)["rate"])
    assert "| 2.0 " in ventricles_page(CASES, 26, LEAST)


def test_without_a_right_name_there_is_no_amplitude():
    assert "none to compare" in ventricles_page(CASES[:1], 1, LEAST)


def test_it_is_drawn(tmp_path):
    write_figure(tmp_path / "figure.png", plot_ventricles(CASES))
    assert (tmp_path / "figure.png").stat().st_size > 5_000
