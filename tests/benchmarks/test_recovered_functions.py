"""Figure of recovered functions beside the hidden ones."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.recovered_functions import Recovered, plot_recovered
from heartfit.discovery.sphere_model.cause import PlaceFunction

TIMES = np.linspace(0.0, 0.8, 81)
HIDDEN = 1e-4 * np.sin(2.0 * np.pi * TIMES / 0.8)
FUNCTION = PlaceFunction("leak", "m^3/s", TIMES, HIDDEN, np.full(81, 1e-5), HIDDEN)


def test_the_correlation_of_a_function_with_itself_is_one_and_with_its_opposite_minus_one() -> None:
    assert Recovered(FUNCTION, HIDDEN).correlation() == pytest.approx(1.0)
    assert Recovered(FUNCTION, 3e-5 - 2.0 * HIDDEN).correlation() == pytest.approx(-1.0)


def test_times_at_which_nothing_is_known_do_not_count() -> None:
    unknown = TIMES > 0.4
    vague = replace(FUNCTION, sd=np.where(unknown, 1.0, 1e-5))
    wrong = np.where(unknown, -HIDDEN, HIDDEN)
    assert Recovered(vague, wrong).correlation() > 0.99 > Recovered(FUNCTION, wrong).correlation()


def test_the_figure_has_a_panel_for_each_effect_in_printed_units() -> None:
    axes, other = plot_recovered(
        {"defect": Recovered(FUNCTION, HIDDEN), "other": Recovered(FUNCTION, HIDDEN)}
    ).axes
    assert axes.get_title().startswith("defect: acts\nas a leak")
    hidden = next(line for line in axes.lines if line.get_label() == "hidden")
    assert hidden.get_ydata() == pytest.approx(1e6 * HIDDEN)
    assert other.get_title().endswith("r = 1.00")
