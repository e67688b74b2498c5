"""Gains of unnamed mechanisms: the best first, as a table, a figure and a file."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import Attempt, Cause, Gain, Refitted, Trace
from heartfit.io.refits import read_attempt, write_attempt
from heartfit.results.attempts import attempts_table, plot_attempts

TIMES = np.arange(8) * 0.1


def attempt(name: str, ratio: float) -> Attempt:
    size = Cause(name, np.nan, 0.5e3, "Pa", (0.2e3, 0.8e3))
    refitted = Refitted((size,), 1.2, {"mu": 1.0}, {"mu": 1.1}, 42, converged=False)
    gains = tuple(
        Gain(curve, "never fitted", 4e-6, ratio * 4e-6, ratio, (ratio - 0.1, ratio + 0.1))
        for curve in ("lv_volume", "rv_volume", "longitudinal strain")
    )
    values = np.full(8, 1e-4)
    return Attempt(refitted, gains, (Trace("lv_volume", TIMES, *(values,) * 6),))


ATTEMPTS = [attempt("SeptalLoad", 1.05), attempt("AtrialSurge", 0.8), attempt("BaseDescent", 1.3)]


def test_the_best_predictor_of_the_left_volume_comes_first() -> None:
    table = attempts_table(ATTEMPTS)
    assert table["mechanism"].tolist() == ["atrial surge", "septal load", "base descent"]
    row = table.iloc[0]
    assert row["size"] == "0.5 (0.2 to 0.8) kPa"
    assert row["LV volume, other frames"] == "0.80 (0.70 to 0.90)"
    assert (row["ln BF"], row["at rest"], row["beats"]) == ("1.2", "no", 42)


def test_the_figure_has_a_panel_for_each_judge_and_colours_what_surely_helps() -> None:
    volume, *panels = plot_attempts(ATTEMPTS, "patient1").axes
    assert len(panels) == 3
    assert [label.get_text() for label in panels[0].get_yticklabels()] == [
        "atrial surge",
        "septal load",
        "base descent",
    ]
    colours = [line.get_color() for line in panels[0].lines[1::2]]
    assert len(set(colours)) == 3, "helpful, undecided and harmful"
    assert len(volume.lines) == 5


def test_an_attempt_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = tmp_path / "trial.json"
    write_attempt(path, ATTEMPTS[1], "0123")
    restored = read_attempt(path)
    assert restored.gain == ATTEMPTS[1].gain
    assert restored.refitted.extension[0].interval == (0.2e3, 0.8e3)
    assert np.isnan(restored.refitted.extension[0].ln_bayes_factor)
    assert restored.traces[0].times == pytest.approx(TIMES)
    with pytest.raises(InputError, match="absent"):
        read_attempt(tmp_path / "absent.json")
