"""Alternatives to an element, printed and drawn."""

import numpy as np

from heartfit.discovery.sphere_model.cause import Gain
from heartfit.io.figures import write_figure
from heartfit.observation.curve import Curve
from heartfit.results.element import element_table, plot_element
from heartfit.synthetic.element import CompetingModel

TIMES = np.arange(25) * 0.032
VOLUME = Curve(TIMES, 1e-4 + 3e-5 * np.cos(2.0 * np.pi * TIMES / 0.8), 0.8)
PRESSURE = Curve(TIMES, 8e3 - 7e3 * np.cos(2.0 * np.pi * TIMES / 0.8), 0.8)
CURVES = {"lv_volume": VOLUME, "lv_pressure": PRESSURE}


def comparison(name, evidence, contractility, gains=()):
    return CompetingModel(name, evidence, 80.0, 57, 23, {"sigma_0": contractility}, CURVES, gains)


GAIN = Gain("lv_volume", "frames", 2e-6, 1e-6, 0.5, (0.4, 0.7))
COMPARISONS = [comparison("p1", -60.0, 330e3), comparison("mixed", -40.0, 255e3, (GAIN,))]


def test_the_gain_of_an_extension_is_listed_beside_the_baseline():
    table = element_table(COMPARISONS, {"sigma_0": 250e3})
    assert table["ln Bayes factor"].tolist() == [0.0, 20.0]
    assert table["lv_volume, error ratio"].fillna("").tolist() == ["", "0.50 (0.40 to 0.70)"]
    assert table["sigma_0 (%)"].round().tolist() == [32.0, 2.0]


def test_the_figure_is_drawn(tmp_path):
    errors = {"lv_volume": np.full(25, 1e-6), "lv_pressure": np.full(25, 100.0)}
    write_figure(tmp_path / "figure.png", plot_element(CURVES, errors, COMPARISONS))
    assert (tmp_path / "figure.png").stat().st_size > 5_000
