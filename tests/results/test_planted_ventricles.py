"""Verdicts on effects hidden in three dimensions, printed and drawn."""

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.io.figures import write_figure
from heartfit.results.planted_figures import plot_ventricles
from heartfit.results.planted_summary import ventricles_extent, ventricles_rates, ventricles_tables
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import DetectableSizes, Scored
from heartfit.synthetic.trial import ScoredDiagnosis


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


def test_the_extent_states_seeds_errors_and_sizes():
    extent = dict(ventricles_extent(CASES, 2601).to_numpy().tolist())
    assert (extent["hearts planned"], extent["seeds"]) == ("2601", "907 to 909")
    assert extent["error of the registered volume (% of EDV), largest"] == "2.00"
    assert extent["size of right names over the planted one (quartiles)"] == "0.75 (0.75 to 0.75)"
    assert extent["planted size in the interval, of right names"] == "1 of 1"


def test_only_effects_above_their_limit_count_against_the_target():
    below = DetectableSizes({("Leak", 1.0): 3.0})
    rates = ventricles_rates(CASES, LEAST).set_index("rate")
    assert rates.loc["singles above their limit, named right", "count"] == "1 of 2"
    assert "singles above their limit, named right" not in set(ventricles_rates(CASES, below)["rate"])
    tables = ventricles_tables(CASES, LEAST, 3)
    assert tables["mechanisms"]["limit (scales)"].tolist() == ["2.0"]
    assert len(tables["cases"]) == 3


def test_without_a_right_name_there_is_no_amplitude():
    extent = dict(ventricles_extent(CASES[:1], 1).to_numpy().tolist())
    assert extent["size of right names over the planted one (quartiles)"] == ""


def test_the_figure_is_drawn(tmp_path):
    write_figure(tmp_path / "figure.png", plot_ventricles(CASES))
    assert (tmp_path / "figure.png").stat().st_size > 5_000
